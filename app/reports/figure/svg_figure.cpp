// SPDX-License-Identifier: Apache-2.0
#include "app/reports/figure/svg_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben::reports {
namespace {

constexpr double kWidth = 760.0;
constexpr double kLeft = 72.0;
constexpr double kRight = 20.0;
constexpr double kPanel = 200.0;  // Of a panel that is no map.
constexpr double kBelow = 48.0;   // Its axis' numbers and title.
constexpr double kLine = 18.0;
constexpr double kKey = 20.0;  // Above it.
constexpr std::size_t kCaptionWidth = 108;

std::string escaped(const std::string& text) {
  std::string out;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      default:
        out += letter;
    }
  }
  return out;
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void take(double value) {
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  [[nodiscard]] double width() const { return high - low; }
  /// Some room at both ends; something to draw on where there is nothing.
  void widen() {
    if (!(width() > 0.0)) {
      const double middle = std::isfinite(low) ? low : 0.0;
      low = middle - 0.5;
      high = middle + 0.5;
      return;
    }
    const double room = 0.04 * width();
    low -= room;
    high += room;
  }
};

/// 1, 2 or 5 times a power of ten, so that about `count` fit.
double tick_step(double width, double count) {
  const double rough = width / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) {
      return factor * power;
    }
  }
  return 10.0 * power;
}

/// From values to places on the sheet.
struct Frame {
  Range x;
  Range y;
  double top = 0.0;
  double height = kPanel;

  [[nodiscard]] double at_x(double value) const {
    return kLeft + (value - x.low) / x.width() * (kWidth - kLeft - kRight);
  }
  [[nodiscard]] double at_y(double value) const {
    return top + height - (value - y.low) / y.width() * height;
  }
};

Frame frame_of(const FigurePanel& panel, double top) {
  Frame frame;
  frame.top = top;
  for (const FigureCurve& curve : panel.curves) {
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (std::isfinite(curve.x[i]) && std::isfinite(curve.y[i])) {
        frame.x.take(curve.x[i]);
        frame.y.take(curve.y[i]);
      }
    }
  }
  frame.x.widen();
  frame.y.widen();
  if (panel.is_map) {
    frame.height = frame.y.width() / frame.x.width() * (kWidth - kLeft - kRight);
  }
  return frame;
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     escaped(text));
}

std::string axes(const FigurePanel& panel, const Frame& frame) {
  const double bottom = frame.top + frame.height;
  std::string out =
      fmt::format("<rect class=\"frame\" x=\"{}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\"/>\n",
                  kLeft, frame.top, kWidth - kLeft - kRight, frame.height);
  const double x_step = tick_step(frame.x.width(), 8.0);
  for (double at = std::ceil(frame.x.low / x_step) * x_step; at <= frame.x.high; at += x_step) {
    out += fmt::format("<path class=\"grid\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>\n", frame.at_x(at),
                       frame.top, bottom) +
           text_at(frame.at_x(at), bottom + 14.0, "middle", fmt::format("{:.6g}", at + 0.0));
  }
  const double y_step = tick_step(frame.y.width(), frame.height / 40.0);
  for (double at = std::ceil(frame.y.low / y_step) * y_step; at <= frame.y.high; at += y_step) {
    out += fmt::format("<path class=\"grid\" d=\"M{} {:.1f}H{}\"/>\n", kLeft, frame.at_y(at),
                       kWidth - kRight) +
           text_at(kLeft - 6.0, frame.at_y(at) + 4.0, "end",
                   fmt::format("{:.6g}", std::abs(at) < 1e-9 * y_step ? 0.0 : at));
  }
  out += text_at(0.5 * (kLeft + kWidth - kRight), bottom + 32.0, "middle", panel.x_title);
  const double middle = frame.top + 0.5 * frame.height;
  out += fmt::format(
      "<text x=\"14\" y=\"{0:.1f}\" text-anchor=\"middle\" transform=\"rotate(-90 14 "
      "{0:.1f})\">{1}</text>\n",
      middle, escaped(panel.y_title));
  return out;
}

std::string line(const FigureCurve& curve, const Frame& frame) {
  std::string path;
  bool is_down = false;
  double last_x = 0.0;
  double last_y = 0.0;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) {
      is_down = false;
      continue;
    }
    const double x = frame.at_x(curve.x[i]);
    const double y = frame.at_y(curve.y[i]);
    // What moves by less than a fifth of a pixel is not seen.
    if (is_down && std::hypot(x - last_x, y - last_y) < 0.2) {
      continue;
    }
    path += fmt::format("{}{:.1f} {:.1f}", is_down ? "L" : "M", x, y);
    is_down = true;
    last_x = x;
    last_y = y;
  }
  return fmt::format("<path class=\"curve\" stroke=\"{}\"{} d=\"{}\"/>\n", curve.colour,
                     curve.dotted ? " stroke-dasharray=\"2 4\"" : "", path);
}

std::string key(const FigurePanel& panel, const Frame& frame) {
  std::string out;
  double x = kLeft + 8.0;
  for (const FigureCurve& curve : panel.curves) {
    if (!curve.label.empty()) {
      out += fmt::format("<path class=\"curve\" stroke=\"{}\"{} d=\"M{:.1f} {:.1f}h22\"/>\n",
                         curve.colour, curve.dotted ? " stroke-dasharray=\"2 4\"" : "", x,
                         frame.top - 10.0) +
             text_at(x + 27.0, frame.top - 6.0, "start", curve.label);
      x += 46.0 + 7.0 * static_cast<double>(curve.label.size());
    }
  }
  return out;
}

std::string panel_text(const FigurePanel& panel, const Frame& frame) {
  std::string out = axes(panel, frame);
  for (const FigureCurve& curve : panel.curves) {
    out += line(curve, frame);
  }
  for (const FigureMark& mark : panel.marks) {
    out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"/>\n", frame.at_x(mark.x),
                       frame.at_y(mark.y)) +
           text_at(frame.at_x(mark.x) + 6.0, frame.at_y(mark.y) - 5.0, "start", mark.text);
  }
  return out + key(panel, frame);
}

/// A caption's lines.
std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines(1);
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find(' ', from), text.size());
    if (!lines.back().empty() && lines.back().size() + 1 + to - from > kCaptionWidth) {
      lines.emplace_back();
    }
    lines.back() += (lines.back().empty() ? "" : " ") + text.substr(from, to - from);
    from = to + 1;
  }
  return lines;
}

}  // namespace

std::string svg_text(const PaperFigure& figure) {
  std::string body;
  double top = 4.0;
  for (const FigurePanel& panel : figure.panels) {
    top += kKey;
    const Frame frame = frame_of(panel, top);
    body += panel_text(panel, frame);
    top += frame.height + kBelow;
  }
  for (const std::string& caption : lines_of(figure.caption)) {
    top += kLine;
    body += text_at(kLeft, top, "start", caption);
  }
  if (!figure.numbers.empty()) {
    top += 1.5 * kLine;
    body += "<g class=\"numbers\">\n" + text_at(430.0, top, "start", "in the paper") +
            text_at(590.0, top, "start", "here");
    for (const PaperNumber& number : figure.numbers) {
      top += kLine;
      body += text_at(kLeft, top, "start", number.what) +
              text_at(430.0, top, "start", number.paper) +
              text_at(590.0, top, "start", number.ours);
    }
    body += "</g>\n";
  }
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1:.0f}\" viewBox=\"0 0 "
      "{0} "
      "{1:.0f}\">\n<title>{2}</title>\n<style>text{{font:12px sans-serif;fill:#222}}"
      ".frame{{fill:none;stroke:#444}}.grid{{stroke:#ddd}}.curve{{fill:none;stroke-width:1.5}}"
      "</style>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{3}</svg>\n",
      kWidth, top + kLine, escaped(figure.name), body);
}

}  // namespace graben::reports
