#include "mems_stiction/base/private_folder.hpp"

#include <stdlib.h>

#include <string>
#include <system_error>

#include "mems_stiction/base/errors.hpp"

namespace mems_stiction {

PrivateFolder::PrivateFolder()
    : scratch_([] {
        std::string pattern = (std::filesystem::temp_directory_path() / "mems_stiction.XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr) throw FileError(pattern + ": the temporary folder cannot be made");
        return pattern;
      }) {}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(scratch_.path(), ignored);
}

}  // namespace mems_stiction
