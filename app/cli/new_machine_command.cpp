// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/output_file.hpp"
#include "app/cli/program.hpp"
#include "app/machines/any_machine.hpp"
#include "app/machines/new/data_sheet.hpp"
#include "app/machines/new/new_profile.hpp"
#include "app/machines/new/origin.hpp"
#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"

namespace graben::cli {
namespace {

namespace fs = std::filesystem;

struct NewMachine {
  std::string like = "excavator_12t";
  std::string out;
  bool force = false;
};

std::string numbers_text(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) {
    texts.push_back(fmt::format("{:.6g}", number));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// Numbers with commas or blanks between them. Throws std::runtime_error that says what is wrong.
std::vector<double> numbers_of(const machines::ProfileQuestion& question, std::string line) {
  for (char& c : line) {
    c = c == ',' ? ' ' : c;
  }
  std::istringstream words(line);
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    double number = 0.0;
    if (!CLI::detail::lexical_cast(word, number) || !std::isfinite(number)) {
      throw std::runtime_error(fmt::format("'{}' is not a number", word));
    }
    numbers.push_back(number);
  }
  const std::size_t wanted = question.before.size();
  if (numbers.size() != wanted) {
    throw std::runtime_error(
        fmt::format("{} {} wanted, not {}: a comma stands between numbers, not in one", wanted,
                    wanted == 1 ? "number is" : "numbers are", numbers.size()));
  }
  for (const double number : numbers) {
    if (number < question.least || number > question.most) {
      throw std::runtime_error(fmt::format("{:.6g} is out of range; allowed: {:.6g} .. {:.6g} {}",
                                           number, question.least, question.most,
                                           question.unit.name));
    }
  }
  return numbers;
}

/// Standard input: an answer a line in the order of asking, or, where its first line is
/// "KEY = ANSWER", by their keys, in any order: which questions come depends on answers before.
class AnswerLines {
 public:
  /// Throws std::runtime_error for an input that has nothing in it, not even empty lines: that is
  /// no wish to keep everything.
  AnswerLines() {
    if (is_person()) {
      return;
    }
    if (std::cin.peek() == std::istream::traits_type::eof()) {
      throw std::runtime_error(
          "no answers: standard input is empty; a line for each question is wanted, an empty one "
          "keeps its value");
    }
    std::string line;
    while (std::getline(std::cin, line)) {
      line_.push_back(line);
    }
    is_named_ = line_.front().find('=') != std::string::npos;
    for (std::size_t i = 0; is_named_ && i < line_.size(); ++i) {
      take_named(line_[i]);
    }
  }

  [[nodiscard]] static bool is_person() { return isatty(STDIN_FILENO) != 0; }

  /// None at the input's end, or where the key is not there.
  std::optional<std::string> next(const std::string& key) {
    std::string line;
    if (is_person()) {
      return std::getline(std::cin, line) ? std::optional(line) : std::nullopt;
    }
    if (is_named_) {
      const auto found = named_.find(key);
      return found == named_.end() ? std::nullopt : std::optional(named_.extract(found).mapped());
    }
    return at_ < line_.size() ? std::optional(line_[at_++]) : std::nullopt;
  }

  void assert_used() const {
    if (!named_.empty()) {
      throw std::runtime_error(fmt::format(
          "{}: is not asked of such a machine, or a slip of the pen", named_.begin()->first));
    }
    for (std::size_t i = at_; !is_named_ && i < line_.size(); ++i) {
      if (line_[i].find_first_not_of(" \t\r") != std::string::npos) {
        throw std::runtime_error(fmt::format(
            "'{}', line {}: more answers than questions; answers by KEY = ANSWER come in any order",
            line_[i], i + 1));
      }
    }
  }

 private:
  void take_named(const std::string& line) {
    const auto trimmed = [](const std::string& text) {
      const std::size_t begin = text.find_first_not_of(" \t\r");
      return begin == std::string::npos
                 ? std::string()
                 : text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
    };
    const std::size_t equals = line.find('=');
    if (equals != std::string::npos) {
      const std::string key = trimmed(line.substr(0, equals));
      if (!named_.emplace(key, trimmed(line.substr(equals + 1))).second) {
        throw std::runtime_error(fmt::format("{}: is answered twice", key));
      }
    } else if (!trimmed(line).empty()) {
      throw std::runtime_error(
          fmt::format("'{}': KEY = ANSWER is wanted, as in the first line", trimmed(line)));
    }
  }

  std::vector<std::string> line_;
  std::size_t at_ = 0;
  bool is_named_ = false;
  std::map<std::string, std::string> named_;
};

/// None where the line is empty: what was before stays. A person is asked again, a file is not: its
/// next line is another answer.
std::optional<std::vector<double>> ask(const machines::ProfileQuestion& question,
                                       const machines::ProfileDocument& like,
                                       const machines::ProfileAnswers& answers,
                                       AnswerLines& lines) {
  while (true) {
    fmt::print("{}: {}, {} [{}]: ", question.key, question.text, question.unit.name,
               numbers_text(question.before));
    std::fflush(stdout);
    const std::string line = lines.next(question.key).value_or("");
    if (!AnswerLines::is_person() || std::cin.eof()) {
      fmt::print("{}\n", line);
    }
    if (line.find_first_not_of(" \t\r") == std::string::npos) {
      return std::nullopt;
    }
    try {
      const std::vector<double> numbers = numbers_of(question, line);
      machines::assert_fits(like, question, numbers, answers);
      return numbers;
    } catch (const std::runtime_error& error) {
      if (!AnswerLines::is_person()) {
        throw std::runtime_error(fmt::format("{}: {}", question.key, error.what()));
      }
      fmt::print("  {}\n", error.what());
    }
  }
}

void load_simulation(const fs::path& file) {
  if (machines::profile_kind(file) == machines::MachineKind::kDozer) {
    static_cast<void>(machines::load_simulated_dozer(file));
  } else {
    static_cast<void>(machines::load_simulated_excavator(file));
  }
}

void new_machine(const NewMachine& options) {
  const fs::path file(options.out);
  if (fs::exists(file) && !options.force) {
    throw std::runtime_error(fmt::format("{}: is there already; --force replaces it", options.out));
  }
  const machines::ProfileDocument after =
      machines::read_document(machines::find_profile(options.like));
  AnswerLines lines;
  assert_writable(file);
  fmt::print("Empty lines keep the value in brackets, {}'s.\n", after.file.stem().string());
  machines::ProfileAnswers answers;
  for (const machines::ProfileQuestion& question : machines::sheet_questions(after)) {
    if (const auto answer = ask(question, after, answers, lines)) {
      answers[question.key] = *answer;
    }
  }
  const machines::ProfileDocument like = machines::with_structure(after, answers);
  for (const machines::ProfileQuestion& question : machines::profile_questions(like)) {
    if (const auto answer = ask(question, like, answers, lines)) {
      answers[question.key] = *answer;
    }
  }
  lines.assert_used();
  const std::string text = machines::new_profile_text(like, file.stem().string(), answers);
  write_whole(file, text);
  fmt::print("profile {}\n", options.out);
  if (const auto origin = machines::origin_of(text)) {
    fmt::print("        {}\n", machines::origin_text(*origin));
  }
  const fs::path simulation_file = machines::simulation_file(file);
  const auto simulation = machines::simulation_of(after, like);
  if (simulation && (options.force || !fs::exists(simulation_file))) {
    write_whole(simulation_file, machines::new_simulation_text(
                                     *simulation, like, file.stem().string(), answers, text));
    fmt::print("its simulation {}\n", simulation_file.string());
  }
  // What does not fit together is said now, with its line; the file is there to be corrected.
  static_cast<void>(machines::load_any(file));
  if (simulation) {
    load_simulation(file);
  }
  fmt::print("next    graben check {}\n", shell_word(options.out));
}

}  // namespace

void add_new_machine(CLI::App& app, int& status) {
  auto options = std::make_shared<NewMachine>();
  CLI::App* command = add_command(app, "new-machine");
  command->add_option("--like", options->like, "Profile that it begins with: file or shipped name")
      ->capture_default_str();
  command->add_option("--out", options->out, "Profile to write, such as mine.toml")->required();
  command->add_flag("--force", options->force, "--out may be there already");
  add_examples(*command, {"new-machine --out mine.toml",
                          "new-machine --like dozer_9t --out mine.toml < answers.txt"});
  command->callback(
      [options, &status] { status = guarded("new-machine", [&] { new_machine(*options); }); });
}

}  // namespace graben::cli
