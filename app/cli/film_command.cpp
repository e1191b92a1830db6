// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <regex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "app/cli/browser.hpp"
#include "app/cli/child_process.hpp"
#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/cli/output_file.hpp"
#include "app/cli/program.hpp"
#include "app/cli/program_files.hpp"
#include "app/runs/run_log.hpp"
#include "platform/linux/process.hpp"

namespace graben::cli {
namespace {

namespace fs = std::filesystem;

struct FilmCommand {
  std::string log;
  std::string out;
  std::string profile;
  std::string bus;
  std::string size = "1280x720";
  int fps = 25;
  double speed = 1.0;
  double from_s = 0.0;
  std::optional<double> until_s;
  bool force = false;
};

struct Size {
  int width;
  int height;
};

/// Encoders want even numbers.
Size size_of(const std::string& text) {
  std::smatch numbers;
  Size size{0, 0};
  if (std::regex_match(text, numbers, std::regex("([0-9]{3,4})x([0-9]{3,4})"))) {
    size = {std::stoi(numbers[1]), std::stoi(numbers[2])};
  }
  const auto fits = [](int pixels) { return pixels >= 320 && pixels <= 3840 && pixels % 2 == 0; };
  if (!fits(size.width) || !fits(size.height)) {
    throw std::runtime_error(fmt::format(
        "--size: '{}'; allowed: WIDTHxHEIGHT, both even and 320 .. 3840, as in 1280x720", text));
  }
  return size;
}

std::vector<std::string> encoder_words(const FilmCommand& options, const fs::path& file) {
  std::vector<std::string> words = {"ffmpeg",
                                    "-hide_banner",
                                    "-loglevel",
                                    "error",
                                    "-y",
                                    "-f",
                                    "image2pipe",
                                    "-c:v",
                                    "mjpeg",
                                    "-framerate",
                                    std::to_string(options.fps),
                                    "-i",
                                    "-"};
  const bool is_webm = fs::path(options.out).extension() == ".webm";
  const std::vector<std::string> codec =
      is_webm ? std::vector<std::string>{"-c:v",    "libvpx-vp9", "-crf",     "30",        "-b:v",
                                         "0",       "-deadline",  "realtime", "-cpu-used", "6",
                                         "-row-mt", "1",          "-f",       "webm"}
              : std::vector<std::string>{"-c:v", "libx264", "-crf", "20", "-f", "mp4"};
  words.insert(words.end(), {"-pix_fmt", "yuv420p"});
  words.insert(words.end(), codec.begin(), codec.end());
  words.push_back(file.string());
  return words;
}

/// A folder for what the helpers write, gone afterwards.
class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "graben_film_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error(fmt::format("{}: no folder can be made there", name));
    }
    folder = name;
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  fs::path folder;
};

std::string first_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line.empty() ? "without a word" : line;
}

/// The address of `scope`, once it has said it.
std::string address(ChildProcess& scope, const fs::path& said) {
  constexpr double kBegin_s = 60.0;
  try {
    const std::string line = scope.read_until(STDOUT_FILENO, '\n', kBegin_s);
    std::smatch found;
    if (std::regex_search(line, found, std::regex("http://[^ ]+"))) {
      return found[0];
    }
  } catch (const std::runtime_error&) {
    // What it said instead is in the file.
  }
  throw std::runtime_error(first_line(said));
}

/// Opens the log's page and waits until all of the log is in it; returns its first and last second.
std::pair<double, double> open_log(Browser& browser, const std::string& url) {
  browser.open(url + "?film");
  constexpr int kLooks = 3000;  // Of 100 ms: an hour of log takes seconds, on a slow machine more.
  for (int look = 0; look < kLooks; ++look) {
    assert_not_stopped();
    const nlohmann::json state = browser.evaluate("window.grabenFilm?.state() ?? ''");
    if (state == "ready") {
      const nlohmann::json extent = browser.evaluate("window.grabenFilm.extent()");
      return {extent.at(0), extent.at(1)};
    }
    if (state.is_string() && !state.get<std::string>().empty()) {
      throw std::runtime_error(state.get<std::string>());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  throw std::runtime_error("the page does not come to the log's end");
}

/// The moments of the pictures, in the log's seconds.
std::vector<double> moments(const FilmCommand& options, std::pair<double, double> extent) {
  const double first_s = extent.first + options.from_s;
  const double last_s =
      options.until_s ? std::min(extent.second, extent.first + *options.until_s) : extent.second;
  if (!(last_s > first_s)) {
    throw std::runtime_error(
        fmt::format("--from, --until: nothing is between; the log is {:.2f} s long",
                    extent.second - extent.first));
  }
  std::vector<double> times;
  const double step_s = options.speed / options.fps;
  const auto count = static_cast<std::size_t>(std::ceil((last_s - first_s) / step_s - 1e-9));
  for (std::size_t i = 0; i < std::max<std::size_t>(1, count); ++i) {
    times.push_back(first_s + static_cast<double>(i) * step_s);
  }
  return times;
}

/// Returns how many pictures there are.
std::size_t film(const FilmCommand& options, const Size& size, const fs::path& file) {
  const Scratch scratch;
  std::vector<std::string> server = {
      graben_file().string(), "scope", "--log", options.log, "--port", "0"};
  if (!options.profile.empty()) {
    server.insert(server.end(), {"--profile", options.profile});
  }
  if (!options.bus.empty()) {
    server.insert(server.end(), {"--bus", options.bus});
  }
  const fs::path said = scratch.folder / "scope.txt";
  ChildProcess scope(server, {{STDOUT_FILENO, ChildProcess::Way::kChildWrites}}, said.string());
  const std::string url = address(scope, said);
  Browser browser(scratch.folder, size.width, size.height);
  const std::vector<double> times = moments(options, open_log(browser, url));
  const fs::path complaint = scratch.folder / "ffmpeg.txt";
  ChildProcess encoder(encoder_words(options, file),
                       {{STDIN_FILENO, ChildProcess::Way::kChildReads}}, complaint.string());
  ProgressBar bar("film");
  for (std::size_t i = 0; i < times.size(); ++i) {
    assert_not_stopped();
    browser.evaluate(fmt::format("window.grabenFilm.show({:.6f})", times[i]));
    encoder.write(STDIN_FILENO, browser.picture());
    bar.show(static_cast<double>(i + 1) / static_cast<double>(times.size()),
             fmt::format("{} of {} pictures", i + 1, times.size()));
  }
  if (encoder.finish(STDIN_FILENO) != 0) {
    throw std::runtime_error(fmt::format("ffmpeg: {}", first_line(complaint)));
  }
  return times.size();
}

void make_film(const FilmCommand& options) {
  const Size size = size_of(options.size);
  const std::string extension = fs::path(options.out).extension();
  if (extension != ".webm" && extension != ".mp4") {
    throw std::runtime_error(
        fmt::format("--out: '{}'; allowed: a name that ends with .webm or .mp4", options.out));
  }
  assert_apart({options.log}, {options.out});
  if (fs::exists(options.out) && !options.force) {
    throw std::runtime_error(
        fmt::format("{}: is there already; --force overwrites it", options.out));
  }
  // Refuses what is no log, with its line, before a program is asked for or started.
  static_cast<void>(runs::read_run_log(options.log));
  static_cast<void>(browser_program());
  assert_program("ffmpeg", "ffmpeg");
  assert_writable(options.out);
  if (const ErrorText error = catch_stop_signals(); !error.empty()) {
    throw std::runtime_error(error.c_str());
  }
  const fs::path partial = fmt::format("{}.part-{}", options.out, getpid());
  try {
    const std::size_t pictures = film(options, size, partial);
    fs::rename(partial, options.out);
    fmt::print("{}: {}x{}, {} pictures, {:.2f} s\n", options.out, size.width, size.height, pictures,
               static_cast<double>(pictures) / options.fps);
  } catch (...) {
    std::error_code ignored;
    fs::remove(partial, ignored);
    throw;
  }
}

}  // namespace

void add_film(CLI::App& app, int& status) {
  auto options = std::make_shared<FilmCommand>();
  CLI::App* command = add_command(app, "film");
  command->add_option("log", options->log, "candump log, plain or gzip")->required();
  command->add_option("--out", options->out, "Film to write: .webm (VP9) or .mp4 (H.264)")
      ->required();
  command->add_option("--profile", options->profile,
                      "Machine profile beside the shipped ones: file or shipped name");
  command->add_option("--bus", options->bus,
                      "Bus profile beside the shipped ones that the machine was put on: a file, or "
                      "a shipped name");
  command->add_option("--size", options->size, "Pixels, both even and 320 .. 3840")
      ->capture_default_str();
  command->add_option("--fps", options->fps, "Pictures a second, 1 .. 60")
      ->check(whole_number_between(1, 60))
      ->capture_default_str();
  command->add_option("--speed", options->speed, "Times real time, 0.05 .. 100")
      ->check(number_between(0.05, 100.0))
      ->capture_default_str();
  command->add_option("--from", options->from_s, "Seconds after the log's begin, 0 .. 1000000")
      ->check(number_between(0.0, 1e6))
      ->capture_default_str();
  command
      ->add_option("--until", options->until_s,
                   "Seconds after the log's begin; its end unless told")
      ->check(number_between(0.0, 1e6));
  command->add_flag("--force", options->force, "Overwrite --out");
  add_examples(*command, {"film out/dig.log --out out/dig.webm",
                          "film out/dig.log --out out/fast.mp4 --speed 4 --size 1920x1080"});
  command->callback([options, &status] { status = guarded("film", [&] { make_film(*options); }); });
}

}  // namespace graben::cli
