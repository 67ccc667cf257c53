#pragma once

/// @file
/// Compressed data piece by piece, so that their size is known before memory is taken for them.

#include <zlib.h>

#include <cstdint>
#include <new>
#include <vector>

namespace mems_stiction {

/// Unpacks a stream of zlib, with a header or (window_bits < 0) without, as long as `take(piece,
/// size)` wants more of it.
/// @return Z_STREAM_END if it was there to its end, Z_OK if `take` has ended it, else an error
template <typename Take>
int unpackStream(const Bytef* data, std::uint64_t size, int window_bits, Take take) {
  z_stream stream{};
  if (inflateInit2(&stream, window_bits) != Z_OK) throw std::bad_alloc();
  stream.next_in = const_cast<Bytef*>(data);
  stream.avail_in = static_cast<uInt>(size);
  std::vector<Bytef> buffer(1 << 16);
  int state = Z_OK;
  for (bool wants_more = true; state == Z_OK && wants_more;) {
    stream.next_out = buffer.data();
    stream.avail_out = static_cast<uInt>(buffer.size());
    state = inflate(&stream, Z_NO_FLUSH);
    wants_more = take(buffer.data(), buffer.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  return state;
}

}  // namespace mems_stiction
