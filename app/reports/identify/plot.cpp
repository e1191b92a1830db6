// SPDX-License-Identifier: Apache-2.0
#include "app/reports/identify/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace graben::reports {
namespace {

constexpr double kLeft_px = 52.0;
constexpr double kRight_px = 10.0;
constexpr double kTop_px = 8.0;
constexpr double kBottom_px = 36.0;
constexpr int kTicks = 5;

/// 1, 2 or 5 times a power of ten, for about kTicks of them.
double tick_step(double span) {
  const double rough = span / kTicks;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double times : {1.0, 2.0, 5.0}) {
    if (times * power >= rough) {
      return times * power;
    }
  }
  return 10.0 * power;
}

std::vector<double> ticks(const PlotAxis& axis) {
  const double step = tick_step(axis.most - axis.least);
  std::vector<double> all;
  for (double at = std::ceil(axis.least / step - 1e-9); at * step <= axis.most + 1e-9 * step;
       ++at) {
    all.push_back(at * step);
  }
  return all;
}

}  // namespace

std::string html_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

Plot::Plot(const std::string& title, PlotAxis x, PlotAxis y, double width_px, double height_px)
    : x_(std::move(x)), y_(std::move(y)), width_px_(width_px), height_px_(height_px) {
  text_ = fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n",
                      width_px, height_px, html_escaped(title));
  axes();
}

double Plot::x_px(double value) const {
  return kLeft_px + (value - x_.least) / (x_.most - x_.least) * (width_px_ - kLeft_px - kRight_px);
}

double Plot::y_px(double value) const {
  return height_px_ - kBottom_px -
         (value - y_.least) / (y_.most - y_.least) * (height_px_ - kTop_px - kBottom_px);
}

void Plot::axes() {
  for (const double at : ticks(x_)) {
    text_ += fmt::format(
        "<path class=\"grid\" d=\"M{0:.1f} {1:.1f}V{2:.1f}\"/><text class=\"tick\" x=\"{0:.1f}\" "
        "y=\"{3:.1f}\" text-anchor=\"middle\">{4:.6g}</text>\n",
        x_px(at), kTop_px, height_px_ - kBottom_px, height_px_ - kBottom_px + 14.0, at + 0.0);
  }
  for (const double at : ticks(y_)) {
    text_ += fmt::format(
        "<path class=\"grid\" d=\"M{0:.1f} {1:.1f}H{2:.1f}\"/><text class=\"tick\" x=\"{3:.1f}\" "
        "y=\"{4:.1f}\" text-anchor=\"end\">{5:.6g}</text>\n",
        kLeft_px, y_px(at), width_px_ - kRight_px, kLeft_px - 4.0, y_px(at) + 4.0, at + 0.0);
  }
  text_ +=
      fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n",
                  width_px_ - kRight_px, height_px_ - 6.0, html_escaped(x_.title));
  text_ += fmt::format(
      "<text class=\"tick\" transform=\"translate(12 {:.1f}) rotate(-90)\" "
      "text-anchor=\"end\">{}</text>\n",
      kTop_px, html_escaped(y_.title));
}

void Plot::path(const char* style, const PlotPoints& points, const char* end) {
  if (points.empty()) {
    return;
  }
  text_ += fmt::format("<path class=\"{}\" d=\"", style);
  const char* move = "M";
  for (const auto& [x, y] : points) {
    text_ += fmt::format("{}{:.1f} {:.1f}", move, x_px(std::clamp(x, x_.least, x_.most)),
                         y_px(std::clamp(y, y_.least, y_.most)));
    move = "L";
  }
  text_ += fmt::format("{}\"/>\n", end);
}

void Plot::line(const char* style, const PlotPoints& points) { path(style, points, ""); }
void Plot::area(const char* style, const PlotPoints& points) { path(style, points, "Z"); }

void Plot::dots(const char* style, const PlotPoints& points) {
  for (const auto& [x, y] : points) {
    if (x >= x_.least && x <= x_.most && y >= y_.least && y <= y_.most) {
      text_ += fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\"/>\n", style,
                           x_px(x), y_px(y));
    }
  }
}

std::string Plot::svg() const { return text_ + "</svg>\n"; }

}  // namespace graben::reports
