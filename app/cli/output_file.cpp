#include "app/cli/output_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <system_error>

namespace graben::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file) {
  throw std::runtime_error(fmt::format("{}: can't be written", file.string()));
}

}  // namespace

void assert_writable(const fs::path& file) {
  std::error_code error;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (fs::is_directory(file, error) || !fs::is_directory(folder, error) ||
      access(folder.c_str(), W_OK | X_OK) != 0 ||
      (fs::exists(file, error) && access(file.c_str(), W_OK) != 0)) {
    refuse(file);
  }
}

void write_whole(const fs::path& file, std::string_view text) {
  fs::path partial = file;
  partial += fmt::format(".part-{}", getpid());
  std::ofstream stream(partial, std::ios::binary);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  std::error_code error;
  if (stream) {
    fs::rename(partial, file, error);
  }
  if (!stream || error) {
    fs::remove(partial, error);
    refuse(file);
  }
}

}  // namespace graben::cli
