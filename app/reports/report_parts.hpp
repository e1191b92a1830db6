// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Parts of a report's setup (app/scope/page/src/model/api.ts) that every kind of run has.

#include <cmath>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/runs/figures.hpp"
#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::reports {

/// Text of a report about a run, before its frames: `Run` of the page.
struct RunText {
  std::string title;
  std::string subtitle;
  nlohmann::json summary = nlohmann::json::array();  ///< Of key_figure.
  runs::LimitShares limit_share;                     ///< Empty: there is no lambda.
};

[[nodiscard]] nlohmann::json key_figure(const std::string& label, const std::string& value,
                                        const std::string& unit, const std::string& note);

/// The text with a row for each figure that the run has, and its shares.
[[nodiscard]] RunText run_text(const std::string& title, const std::string& subtitle,
                               const runs::RunFigures& figures);

inline constexpr double kThousandths = 1e3;
/// Unit of a drive's plots: mm, and degrees of the swing; so many of them are one SI unit.
[[nodiscard]] inline const char* drive_unit(unsigned drive) {
  return drive == kSwing ? "deg" : "mm";
}
[[nodiscard]] inline double drive_per_si(unsigned drive) {
  return drive == kSwing ? kDegreesPerRad : kThousandths;
}

/// Rounded to as many decimals as anybody reads off a plot; null where it is not finite.
[[nodiscard]] nlohmann::json plotted(double value, int decimals);

/// Curves over a run's samples that no frame has.
template <class Sample>
class Truth {
 public:
  using Of = std::function<double(const Sample&)>;

  /// `samples` has to outlive this.
  explicit Truth(const std::vector<Sample>& samples) : samples_(samples) {}

  /// A line on the page's plot of that name (view/plot_table.ts); where it has none, on one of its
  /// own by that title.
  void add(const std::string& plot, const std::string& title, const std::string& label,
           const std::string& unit, int decimals, const Of& of) {
    lines_.push_back({{"plot", plot},
                      {"title", title},
                      {"label", label},
                      {"unit", unit},
                      {"values", values(decimals, of)}});
  }

  /// `truth` of the page.
  [[nodiscard]] nlohmann::json json() const {
    constexpr int kMilliseconds = 3;
    return {{"time_s", values(kMilliseconds, [](const Sample& s) { return s.time_s; })},
            {"lines", lines_}};
  }

  /// `way` of the page: places in the ground frame, by the millimetre.
  [[nodiscard]] nlohmann::json way(const Of& x_m, const Of& y_m, const Of& z_m) const {
    constexpr int kMillimetres = 3;
    nlohmann::json places = nlohmann::json::array();
    for (const Sample& sample : samples_) {
      places.push_back({plotted(x_m(sample), kMillimetres), plotted(y_m(sample), kMillimetres),
                        plotted(z_m(sample), kMillimetres)});
    }
    return places;
  }

 private:
  [[nodiscard]] nlohmann::json values(int decimals, const Of& of) const {
    nlohmann::json all = nlohmann::json::array();
    for (const Sample& sample : samples_) {
      all.push_back(plotted(of(sample), decimals));
    }
    return all;
  }

  const std::vector<Sample>& samples_;
  nlohmann::json lines_ = nlohmann::json::array();
};

/// `run` of the page, to which `way` and others may be added.
[[nodiscard]] nlohmann::json run_json(const RunText& text, nlohmann::json truth);

/// The same with the frames of the run's log inside. What is no regular file, such as a device, has
/// nothing to be read back: the report then has no frames, and says so.
void add_log(nlohmann::json& run, const std::filesystem::path& log_file);

/// `Setup` of the page: one machine, the run, and the file that the frames are from.
[[nodiscard]] nlohmann::json report_setup(const std::filesystem::path& log_file,
                                          nlohmann::json machine, nlohmann::json run);

}  // namespace graben::reports
