// SPDX-License-Identifier: Apache-2.0
#include "app/reports/identify/page_style.hpp"

#include <fmt/format.h>

#include "app/reports/identify/plot.hpp"

namespace graben::reports {
namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ink: #1c2733; --soft: #556472; --line: #d8dee5; --paper: #fff; --page: #f2f4f6;
  --old: #5f6e7c; --new: #2566ac; --dot: #d98a00; --dot-word: #8a5600; }
@media screen and (prefers-color-scheme: dark) {
  :root { --ink: #e6eaed; --soft: #a4afb8; --line: #343d45; --paper: #181d22; --page: #0f1316;
    --old: #97a4b0; --new: #78a8ff; --dot: #efb04a; --dot-word: #efb04a; }
}
* { box-sizing: border-box; }
body { margin: 0; font: 15px/1.45 system-ui, sans-serif; color: var(--ink); background: var(--page); }
main { max-width: 1180px; margin: 0 auto; padding: 28px 24px 48px; }
h1 { margin: 0; font-size: 26px; } h1 small { font-weight: 400; color: var(--soft); font-size: 16px; margin-left: 10px; }
h2 { margin: 0 0 8px; font-size: 16px; } h3 { margin: 0 0 4px; font-size: 14px; font-weight: 500; }
section { background: var(--paper); border: 1px solid var(--line); border-radius: 8px; padding: 14px 16px; margin: 16px 0; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(400px, 100%), 1fr)); gap: 14px; }
svg { display: block; width: 100%; height: auto; }
pre { margin: 0; overflow-x: auto; font: 13px/1.5 ui-monospace, monospace; }
p, li { max-width: 75em; } p { margin: 6px 0; color: var(--soft); }
table { border-collapse: collapse; width: 100%; font-size: 13px; }
th, td { text-align: left; padding: 4px 8px; border-bottom: 1px solid var(--line); vertical-align: top; overflow-wrap: anywhere; }
section { min-width: 0; }
th { font-weight: 500; color: var(--soft); } .grid { stroke: var(--ink); stroke-opacity: .1; fill: none; } .tick { font-size: 11px; fill: var(--soft); }
.old { fill: none; stroke: var(--old); stroke-width: 1.5; stroke-dasharray: 5 4; }
.new { fill: none; stroke: var(--new); stroke-width: 2; } .band { fill: var(--new); fill-opacity: .16; }
.measured { fill: none; stroke: var(--ink); stroke-width: 1.2; } .dot { fill: var(--dot); fill-opacity: .45; }
.key { font-weight: 600; } .key.n { color: var(--new); } .key.o { color: var(--old); } .key.d { color: var(--dot-word); }
@media (max-width: 600px) { main { padding: 16px 10px 32px; } section { padding: 10px; } th, td { padding: 3px 4px; } }
@media print { body { background: #fff; } section { break-inside: avoid; } }
)";

}  // namespace

std::string page_head(const std::string& title, const std::string& heading,
                      const std::string& from) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><meta "
      "name=\"viewport\" content=\"width=device-width\"><title>{0}</title>\n"
      "<style>{1}</style></head>\n<body><main>\n<h1>{2}<small>{3}</small></h1>\n",
      html_escaped(title), kStyle, html_escaped(heading), html_escaped(from));
}

std::string listed(const std::vector<std::string>& items) {
  std::string html = "<ul>\n";
  for (const std::string& item : items) {
    html += fmt::format("<li>{}</li>\n", html_escaped(item));
  }
  return html + "</ul>\n";
}

std::string section(const std::string& title, const std::string& text, const std::string& body) {
  return fmt::format("<section><h2>{}</h2>\n<p>{}</p>\n{}</section>\n", title, text, body);
}

}  // namespace graben::reports
