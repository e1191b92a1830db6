// SPDX-License-Identifier: Apache-2.0
#include "app/cli/help.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "app/machines/profile_file.hpp"

namespace graben::cli {
namespace {

constexpr std::size_t kColumn = 26;         // Of an option's text.
constexpr std::size_t kCommandColumn = 14;  // Of a command's.

std::string block(const std::string& head, const std::string& text, std::size_t column) {
  const bool fits = head.size() + 2 <= column;
  return (fits ? fmt::format("{:<{}}", head, column)
               : fmt::format("{}\n{:{}}", wrapped(head, 6, 0), "", column)) +
         wrapped(text, column, column) + "\n";
}

/// CLI11 writes a type as "FLOAT:0.05 .. 1": what it is, then what each check allows.
struct ArgumentType {
  std::string name;
  std::string allowed;
};

ArgumentType type_of(const CLI::Option& option) {
  const std::string full = option.get_type_name();
  const std::size_t colon = full.find(':');
  ArgumentType type{full.substr(0, colon),
                    colon == std::string::npos ? "" : full.substr(colon + 1)};
  if (type.name == "FLOAT" || type.name == "INT" || type.name == "UINT") {
    type.name = "N";
  }
  return type;
}

}  // namespace

std::string argument_text(const CLI::Option& option) {
  if (option.get_type_size() == 0 || option.get_expected_max() == 0) {
    return "";
  }
  const std::string name = type_of(option).name;
  if (option.get_expected_max() == CLI::detail::expected_max_vector_size) {
    return " " + name + " ...";
  }
  std::string all = name;
  for (int i = 1; i < option.get_expected_min(); ++i) {
    all += "," + name;
  }
  return option.get_expected_min() == 0 ? " [" + all + "]" : " " + all;
}

std::vector<std::string> option_words(const CLI::Option& option) {
  std::vector<std::string> words;
  const std::string allowed = type_of(option).allowed;
  if (allowed.find(", ") == std::string::npos) {
    return words;
  }
  for (std::size_t from = 0; from != std::string::npos;) {
    const std::size_t comma = allowed.find(", ", from);
    words.push_back(allowed.substr(from, comma == std::string::npos ? comma : comma - from));
    from = comma == std::string::npos ? comma : comma + 2;
  }
  return words;
}

namespace {

std::string names_of(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) {
    names.push_back(option->get_name());
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string options_text(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : app.get_options()) {
    // A group of options has a help of its own, which is the command's.
    const bool is_again = app.get_name().empty() && option == app.get_help_ptr();
    if (!option->get_group().empty() && !is_again) {
      const bool is_named = option->nonpositional();
      text += block("  " + option->get_name(!is_named, is_named) + argument_text(*option),
                    option_help(*option), kColumn);
    }
  }
  return text;
}

/// Options of which only so many go together.
std::string groups_text(const CLI::App& app) {
  std::string text;
  for (const CLI::App* group : app.get_subcommands({})) {
    if (group->get_name().empty()) {
      const bool is_needed = group->get_require_option_min() > 0;
      text += fmt::format("\n{}:\n",
                          wrapped(fmt::format("{} ({})", group->get_description(),
                                              is_needed ? "one of them" : "at most one of them"),
                                  0, 0)) +
              options_text(*group);
    }
  }
  return text;
}

std::string commands_text(const CLI::App& app) {
  std::string text;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (!command->get_name().empty()) {
      text += block("  " + command->get_name(), command->get_description(), kCommandColumn);
    }
  }
  return text.empty() ? "" : "\nCommands:\n" + text;
}

class Help : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode /*mode*/) const override {
    std::string usage = "\nUsage: " + name;
    for (const CLI::Option* option : app->get_options()) {
      if (!option->nonpositional()) {
        usage += option->get_required() ? " " : " [";
        usage += option->get_name() + (option->get_expected_max() > 1 ? " ..." : "");
        usage += option->get_required() ? "" : "]";
      }
    }
    const std::string commands = commands_text(*app);
    usage += commands.empty() ? " [options]" : " COMMAND [options]";
    return wrapped(app->get_description(), 0, 0) + "\n" + usage + "\n" + commands + "\nOptions:\n" +
           options_text(*app) + groups_text(*app) + app->get_footer();
  }
};

bool reads(const CLI::App& command, const char* option) {
  return command.get_option_no_throw(option) != nullptr;
}

std::string list(const char* what, const std::vector<std::string>& names) {
  return names.empty() ? ""
                       : fmt::format("\n{}: {}\n", what,
                                     wrapped(fmt::format("{}", fmt::join(names, ", ")), 2,
                                             std::string_view(what).size() + 2));
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t indent, std::size_t column) {
  std::string out;
  std::size_t at = column;
  std::size_t from = text.find_first_not_of(' ');
  out.append(from == std::string::npos ? 0 : from, ' ');
  at += from == std::string::npos ? 0 : from;
  bool is_first = true;
  while (from != std::string::npos) {
    const std::size_t to = text.find(' ', from);
    const std::string word = text.substr(from, to == std::string::npos ? to : to - from);
    if (!is_first && at + 1 + word.size() > kHelpWidth) {
      out += "\n" + std::string(indent, ' ');
      at = indent;
    } else if (!is_first) {
      out += ' ';
      ++at;
    }
    out += word;
    at += word.size();
    is_first = false;
    from = to == std::string::npos ? to : text.find_first_not_of(' ', to);
  }
  return out;
}

std::string option_help(const CLI::Option& option) {
  std::string text = option.get_description();
  std::vector<std::string> more;
  const auto add = [&](const std::string& what) {
    if (text.find(what) == std::string::npos) {
      more.push_back(what);
    }
  };
  if (option.get_type_size() != 0 && option.get_expected_max() != 0) {
    const std::string allowed = type_of(option).allowed;
    if (!allowed.empty()) {
      add(allowed);
    }
    if (!option.get_default_str().empty()) {
      more.push_back(option.get_default_str() + " unless told");
    }
  }
  if (option.get_required()) {
    more.push_back("always needed");
  }
  if (!option.get_needs().empty()) {
    more.push_back("only with " + names_of(option.get_needs()));
  }
  if (!option.get_excludes().empty()) {
    more.push_back("not with " + names_of(option.get_excludes()));
  }
  return more.empty() ? text : fmt::format("{} ({})", text, fmt::join(more, "; "));
}

void set_help(CLI::App& app) {
  app.formatter(std::make_shared<Help>());
  app.set_help_flag("-h,--help", "Say this");
}

void add_examples(CLI::App& command, const std::vector<std::string>& examples) {
  std::string text = examples.size() == 1 ? "\nExample:\n" : "\nExamples:\n";
  for (const std::string& example : examples) {
    text += fmt::format("  graben {}\n", example);
  }
  command.footer(text);
}

void add_shipped(CLI::App& app) {
  const std::string profiles = list("Shipped profiles", machines::shipped_profile_names());
  const std::string tasks = list("Shipped tasks", machines::shipped_task_names());
  std::vector<CLI::App*> commands = app.get_subcommands({});
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const std::vector<CLI::App*> below = commands[i]->get_subcommands({});
    commands.insert(commands.end(), below.begin(), below.end());
  }
  for (CLI::App* command : commands) {
    if (!command->get_name().empty()) {
      command->footer(
          command->get_footer() +
          (reads(*command, "--profile") || reads(*command, "profile") || reads(*command, "--like")
               ? profiles
               : "") +
          (reads(*command, "--task") ? tasks : ""));
    }
  }
  app.footer(app.get_footer() + profiles + tasks);
}

}  // namespace graben::cli
