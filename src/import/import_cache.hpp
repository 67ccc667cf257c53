#pragma once

/// @file
/// What gwyddion made of a file, cached by the file's content: the next time nothing needs to be converted.

#include <optional>
#include <string>

namespace mems_stiction {

/// Where conversions are cached: $XDG_CACHE_HOME/mems_stiction or ~/.cache/mems_stiction; none without a home.
std::optional<std::string> importCacheFolder();

/// Digits that change with every change in the code of this room: what older readers made of a file must not pass for what
/// these make of it.
std::string readerVersion();

/// Name of what belongs to these bytes, this ending of the file's name, this program as it is installed now, and the
/// readers of this version.
std::string importCacheKey(const std::string& bytes, const std::string& name_end, const std::string& program,
                           const std::string& readers);

/// The .gwy container cached under this name; none if there is none, or if it is not as it was cached.
std::optional<std::string> cachedConversion(const std::string& key);

/// Caches it, and removes the oldest if all together are more than a gigabyte. Failing is no error: a cache may be full.
void cacheConversion(const std::string& key, const std::string& gwy);

/// Removes all that is cached.
void clearImportCache();

}  // namespace mems_stiction
