// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What `graben` says of itself: help within 80 columns, and wrong usage in words of its own.

#include <CLI/CLI.hpp>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace graben::cli {

inline constexpr std::size_t kHelpWidth = 80;

/// Breaks at blanks so that no line is longer than kHelpWidth, unless a word is; every line but the
/// first has `indent` blanks before it. `column` is where the first line begins.
[[nodiscard]] std::string wrapped(const std::string& text, std::size_t indent, std::size_t column);

/// Name, argument, range and default of an option, then what it is for.
[[nodiscard]] std::string option_help(const CLI::Option& option);

/// " N,N" of an option with two numbers, " [TEXT]" of one that may stand alone, nothing of a flag.
[[nodiscard]] std::string argument_text(const CLI::Option& option);

/// The words that it takes, where it takes no others.
[[nodiscard]] std::vector<std::string> option_words(const CLI::Option& option);

/// All commands and options as JSON.
[[nodiscard]] std::string description_json(const CLI::App& app);

/// The same of the front, with the commands of its programs from what each of them says of itself.
/// Throws std::logic_error where a command has no program, or a program has another one.
[[nodiscard]] std::string description_json(const CLI::App& app,
                                           const std::map<std::string, std::string>& said);

/// Gives the application, and every command that is added afterwards, its help.
void set_help(CLI::App& app);

/// Puts lines to be typed under a command's help, without their "graben ".
void add_examples(CLI::App& command, const std::vector<std::string>& examples);

/// After all commands: what is shipped, under the help of each that reads a profile or a task.
void add_shipped(CLI::App& app);

/// A word without a letter; else the first of the words that should be a command and is none, or an
/// option that comes before one; empty where there is no such slip. To be asked before CLI11
/// parses: it takes the first command that it knows, wherever that stands.
[[nodiscard]] std::string command_slip(const CLI::App& app, const std::vector<std::string>& words);

/// What is wrong with a command line, with the command that it is for, and where to read on.
[[nodiscard]] std::string usage_text(const CLI::App& app, const CLI::ParseError& error);

}  // namespace graben::cli
