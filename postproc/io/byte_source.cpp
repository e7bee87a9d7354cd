// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/byte_source.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

#include "io/input_error.h"
#include "io/output_file.h"

namespace spherocylinder {
namespace {

constexpr std::size_t kInputBytes = std::size_t{1} << 18;
constexpr std::size_t kLargestCall = std::size_t{1} << 30;  // zlib counts in unsigned int

}  // namespace

void ByteSource::StreamEnder::operator()(z_stream *stream) const
{
  inflateEnd(stream);
  delete stream;
}

ByteSource::ByteSource(const std::string &path) : input_(kInputBytes)
{
  note_input(path);
  std::error_code unknown;  // said when it is opened; a pipe has no size
  if (std::filesystem::is_directory(path, unknown))
    throw InputError(fmt::format("{}: is a folder, wanted a dump file", path));
  file_.reset(std::fopen(path.c_str(), "rb"));
  if (!file_)
    throw InputError(
        fmt::format("{}: cannot be opened for reading: {}", path, std::strerror(errno)));
  const auto bytes = std::filesystem::file_size(path, unknown);
  if (!unknown) file_bytes_ = static_cast<double>(bytes);
}

double ByteSource::part_read() const { return file_bytes_ > 0.0 ? bytes_read_ / file_bytes_ : 0.0; }

std::size_t ByteSource::read_file(char *bytes, std::size_t most)
{
  const std::size_t got = std::fread(bytes, 1, most, file_.get());
  if (got < most && std::ferror(file_.get())) throw ReadFailure{std::strerror(errno)};
  bytes_read_ += static_cast<double>(got);
  return got;
}

// Some input if there is any left in the file.
void ByteSource::need_input()
{
  if (begin_ < end_) return;
  begin_ = 0;
  end_ = read_file(reinterpret_cast<char *>(input_.data()), input_.size());
}

std::size_t ByteSource::read(char *bytes, std::size_t most)
{
  if (bytes_read_ == 0.0) {
    need_input();
    if (end_ >= 2 && input_[0] == 0x1f && input_[1] == 0x8b) {
      stream_.reset(new z_stream{});
      constexpr int kGzipOnly = 15 + 16;  // a window of 2^15 bytes; see zlib.h, inflateInit2
      if (inflateInit2(stream_.get(), kGzipOnly) != Z_OK) throw ReadFailure{"zlib cannot start"};
    }
  }
  if (stream_) return inflate_some(bytes, std::min(most, kLargestCall));
  if (begin_ == end_) return read_file(bytes, most);
  const std::size_t given = std::min(most, end_ - begin_);
  std::memcpy(bytes, input_.data() + begin_, given);
  begin_ += given;
  return given;
}

std::size_t ByteSource::inflate_some(char *bytes, std::size_t most)
{
  stream_->next_out = reinterpret_cast<unsigned char *>(bytes);
  stream_->avail_out = static_cast<unsigned>(most);
  while (stream_->avail_out == most) {
    need_input();
    if (begin_ == end_) {
      if (in_member_) throw ReadFailure{"unexpected end of file"};
      break;
    }
    if (!in_member_) {
      // Zeros that fill up a block of a tape are skipped, as gzip does.
      while (begin_ < end_ && input_[begin_] == 0) begin_++;
      if (begin_ == end_) continue;
      if (input_[begin_] != 0x1f) throw ReadFailure{"other bytes follow the compressed data"};
      inflateReset(stream_.get());
      in_member_ = true;
    }
    stream_->next_in = input_.data() + begin_;
    stream_->avail_in = static_cast<unsigned>(end_ - begin_);
    const int result = inflate(stream_.get(), Z_NO_FLUSH);
    begin_ = end_ - stream_->avail_in;
    if (result == Z_STREAM_END)
      in_member_ = false;
    else if (result != Z_OK && result != Z_BUF_ERROR)
      throw ReadFailure{stream_->msg != nullptr ? stream_->msg : "the compressed data is damaged"};
  }
  return most - stream_->avail_out;
}

}  // namespace spherocylinder
