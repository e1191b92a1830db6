// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <sstream>

#include "app/reports/check/machine_check.hpp"

namespace graben::reports {
namespace {

constexpr std::size_t kTextWidth = 80;
/// A table of figures may be a little wider before its rows are taken apart.
constexpr std::size_t kTableWidth = 90;

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return result;
}

std::string warning_count(const MachineCheck& check) {
  const std::size_t count = check.warnings.size();
  return count == 0 ? "no warnings" : fmt::format("{} warning{}", count, count == 1 ? "" : "s");
}

/// Numbers stand right, words left.
bool is_number(const std::string& cell) {
  return !cell.empty() && cell.find_first_of("0123456789") <= 1 && cell.find(';') == cell.npos;
}

/// Lines of words, none wider than `width` unless a word is.
std::vector<std::string> folded(const std::string& text, std::size_t width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (lines.empty() || lines.back().size() + 1 + word.size() > width) {
      lines.push_back(word);
    } else {
      lines.back() += " " + word;
    }
  }
  return lines;
}

std::size_t longest(const std::vector<std::string>& lines) {
  std::size_t most = 0;
  for (const std::string& line : lines) {
    most = std::max(most, line.size());
  }
  return most;
}

/// The heads of columns no wider than what is below them, on as many lines as that takes.
std::vector<std::vector<std::string>> folded_heads(const std::vector<std::string>& heads,
                                                   std::vector<std::size_t>& width) {
  std::vector<std::vector<std::string>> lines;
  for (std::size_t i = 0; i < heads.size(); ++i) {
    width[i] = std::max(width[i], longest(folded(heads[i], 0)));
    const std::vector<std::string> head = folded(heads[i], width[i]);
    while (lines.size() < head.size()) {
      lines.insert(lines.begin(), std::vector<std::string>(heads.size()));
    }
    for (std::size_t line = 0; line < head.size(); ++line) {
      lines[lines.size() - head.size() + line][i] = head[line];
    }
  }
  return lines;
}

std::string note_text(const FactTable& table) {
  std::string text;
  for (const std::string& line : folded("(" + table.note + ")", kTextWidth - 2)) {
    text += table.note.empty() ? "" : "  " + line + "\n";
  }
  return text;
}

/// Of cells that are too long to stand beside each other: below each other, each with its head.
std::string blocks_text(const FactTable& table) {
  std::string text = table.title + "\n";
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string head = i < table.columns.size() ? table.columns[i] + ": " : "";
      for (const std::string& line : folded(head + row[i], kTextWidth - 6)) {
        text += (i == 0 && line.rfind(head, 0) == 0 ? "  " : "    ") + line + "\n";
      }
    }
  }
  return text + note_text(table);
}

std::string table_text(const FactTable& table) {
  std::vector<std::size_t> width(table.columns.size(), 0);
  for (const auto& line : table.rows) {
    width.resize(std::max(width.size(), line.size()), 0);
    for (std::size_t i = 0; i < line.size(); ++i) {
      width[i] = std::max(width[i], line[i].size());
    }
  }
  std::vector<std::vector<std::string>> lines = folded_heads(table.columns, width);
  if (std::accumulate(width.begin(), width.end(), 2 * width.size()) > kTableWidth) {
    return blocks_text(table);
  }
  lines.insert(lines.end(), table.rows.begin(), table.rows.end());
  std::string text = table.title + "\n";
  for (const auto& line : lines) {
    std::string shown = " ";
    for (std::size_t i = 0; i < line.size(); ++i) {
      const bool is_left =
          i == 0 || (i < table.rows.front().size() && !is_number(table.rows.front()[i]));
      shown += is_left ? fmt::format("{}{:<{}}", i == 0 ? " " : "  ", line[i], width[i])
                       : fmt::format("  {:>{}}", line[i], width[i]);
    }
    shown.erase(shown.find_last_not_of(' ') + 1);
    text += shown.empty() ? "" : shown + "\n";
  }
  return text + note_text(table);
}

std::string table_html(const FactTable& table) {
  std::string html = fmt::format("<section><h2>{}</h2>\n", escaped(table.title));
  if (!table.rows.empty()) {
    // A table wider than a small screen is moved by the arrow keys too: it takes the focus.
    html += fmt::format(
        "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"{}\"><table>\n<tr>",
        escaped(table.title));
    for (const std::string& column : table.columns) {
      // A cell that heads nothing is none of a header's.
      html += column.empty() ? "<td></td>" : "<th scope=\"col\">" + escaped(column) + "</th>";
    }
    html += "</tr>\n";
    for (const auto& row : table.rows) {
      html += "<tr>";
      for (const std::string& cell : row) {
        html += (is_number(cell) ? "<td>" : "<td class=\"left\">") + escaped(cell) + "</td>";
      }
      html += "</tr>\n";
    }
    html += "</table></div>\n";
  }
  return html + (table.note.empty() ? "" : "<p>" + escaped(table.note) + "</p>\n") + "</section>\n";
}

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ink: #1c2733; --soft: #5b6b7a; --line: #d8dee5; --paper: #ffffff;
  --page: #f2f4f6; --code: #fbf1dd; --soil: #efe6d8; --ground: #8a6d46; --iron: #4a5866; --mark: #c0392b;
  --body: #c9d1d9; --track: #6b7885; --reach: #2f74c0; }
@media screen and (prefers-color-scheme: dark) {
  :root { --ink: #e6eaed; --soft: #a4afb8; --line: #343d45; --paper: #181d22;
    --page: #0f1316; --code: #35290f; --soil: #2c251c; --ground: #b0905f; --iron: #9aa8b5; --mark: #ff8577;
    --body: #4a5560; --track: #6b7885; --reach: #78a8ff; }
}
* { box-sizing: border-box; }
body { margin: 0; font: 15px/1.45 system-ui, sans-serif; color: var(--ink); background: var(--page); }
main { max-width: 1180px; margin: 0 auto; padding: 28px 24px 48px; }
h1 { margin: 0; font-size: 26px; }
h1 small { font-weight: 400; color: var(--soft); font-size: 16px; margin-left: 10px; }
h2 { margin: 0 0 8px; font-size: 15px; }
.sheet, section { background: var(--paper); border: 1px solid var(--line); border-radius: 8px; }
.sheet { margin: 16px 0; padding: 12px; }
.sheet svg { display: block; width: 100%; height: auto; max-height: 78vh; }
.left { text-align: left; }
.warnings h2:only-child, .warnings.none h2 { margin: 0; }
.facts { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(470px, 100%), 1fr)); gap: 14px; }
section { padding: 14px 16px; min-width: 0; } .wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { text-align: right; padding: 4px 8px; border-bottom: 1px solid var(--line); vertical-align: bottom; }
td { white-space: nowrap; } td.left { white-space: normal; }
th { font-weight: 500; color: var(--soft); font-size: 13px; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
section p { margin: 8px 0 0; color: var(--soft); font-size: 13px; }
.warnings { margin: 16px 0; border-left: 5px solid #d98a00; }
.warnings.none { border-left-color: #2b8a4b; }
.warnings ul { margin: 6px 0 0; padding: 0; list-style: none; }
.warnings li { padding: 5px 0; border-top: 1px solid var(--line); }
code { font: 13px ui-monospace, monospace; background: var(--code); padding: 1px 5px; border-radius: 3px; }
.soil { fill: var(--soil); } .ground { stroke: var(--ground); stroke-width: 2; fill: none; }
.grid { stroke: var(--ink); stroke-opacity: .06; fill: none; } .grid.five { stroke-opacity: .16; }
.tick { font-size: 11px; fill: var(--soft); } .measure { font-size: 14px; fill: var(--ink); }
.reach { fill: var(--reach); fill-opacity: .10; stroke: var(--reach); stroke-width: 1.5; }
.body { fill: var(--body); stroke: #8492a0; } .track { fill: var(--track); }
.link { fill: #f2b233; stroke: #8a6200; stroke-width: 1.5; stroke-linejoin: round; fill-opacity: .92; }
.link.thin { fill: none; stroke-width: 4; } .ghost { fill-opacity: .12; stroke-opacity: .4; }
.cylinder { stroke: var(--iron); stroke-width: 7; stroke-linecap: round; fill: none; }
.pin { fill: var(--paper); stroke: var(--ink); stroke-width: 1.5; } .teeth { fill: var(--mark); }
.centre { fill: var(--paper); stroke: var(--mark); stroke-width: 2; }
.path { fill: none; stroke: var(--mark); stroke-width: 2; stroke-dasharray: 6 4; }
.dimension { stroke: var(--ink); fill: none; } .axis { stroke: var(--soft); stroke-dasharray: 8 3 2 3; fill: none; }
@media (max-width: 1100px) { .facts { grid-template-columns: minmax(0, 1fr); } }
@media (max-width: 600px) {
  main { padding: 16px 10px 32px; } section { padding: 10px; }
  table { font-size: 12px; } th { font-size: 11px; } th, td { padding: 3px 4px; }
}
@media print { body { background: #fff; } .wide { overflow: visible; } main { padding: 0; } section, .sheet { break-inside: avoid; } }
)";

}  // namespace

std::string check_text(const MachineCheck& check) {
  std::string text = fmt::format("{}: {}, hash {:08x}, {}\n", check.name, check.kind, check.hash,
                                 warning_count(check));
  for (const FactTable& table : check.tables) {
    text += "\n" + table_text(table);
  }
  for (const Warning& warning : check.warnings) {
    text += fmt::format("{}warning: {}: {}\n", &warning == check.warnings.data() ? "\n" : "",
                        warning.key, warning.text);
  }
  return text;
}

std::string check_page(const MachineCheck& check) {
  std::string warnings;
  for (const Warning& warning : check.warnings) {
    warnings +=
        fmt::format("<li><code>{}</code> {}</li>\n", escaped(warning.key), escaped(warning.text));
  }
  std::string facts;
  for (const FactTable& table : check.tables) {
    facts += table_html(table);
  }
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>{0}</title>\n"
      "<style>{1}</style>\n</head>\n<body>\n<main>\n"
      "<h1>{0}<small>{2}, profile hash {3:08x}</small></h1>\n"
      "<section class=\"warnings{4}\"><h2>{5}</h2><ul>\n{6}</ul></section>\n"
      "<div class=\"sheet\">{7}</div>\n<div "
      "class=\"facts\">\n{8}</div>\n</main>\n</body>\n</html>\n",
      escaped(check.name), kStyle, check.kind, check.hash, check.warnings.empty() ? " none" : "",
      warning_count(check), warnings, check.drawing, facts);
}

}  // namespace graben::reports
