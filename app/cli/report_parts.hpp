#pragma once
/// Parts of a report's data that every kind of run has. `Samples` is a list of a run's samples.

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/cli/limit_words.hpp"

namespace graben::cli {

template <class Sample>
[[nodiscard]] nlohmann::json list(const std::vector<Sample>& samples, double Sample::*member) {
  nlohmann::json values = nlohmann::json::array();
  for (const Sample& sample : samples) {
    values.push_back(sample.*member);
  }
  return values;
}

/// One list over the samples for each entry of an array.
template <class Sample, std::size_t kCount>
[[nodiscard]] nlohmann::json lists(const std::vector<Sample>& samples,
                                   std::array<double, kCount> Sample::*member) {
  nlohmann::json all = nlohmann::json::array();
  for (std::size_t i = 0; i < kCount; ++i) {
    nlohmann::json values = nlohmann::json::array();
    for (const Sample& sample : samples) {
      values.push_back((sample.*member)[i]);
    }
    all.push_back(std::move(values));
  }
  return all;
}

/// What held lambda at each sample: `limit` and `limit_names`.
template <class Sample>
void add_limits(nlohmann::json& series, const std::vector<Sample>& samples,
                const ActuatorNames& actuators) {
  std::map<std::string, std::size_t> index = {{"none", 0}};
  nlohmann::json names = {"none"};
  nlohmann::json limits = nlohmann::json::array();
  for (const Sample& sample : samples) {
    const std::string name = limit_words(sample.limit, actuators);
    const auto [found, is_new] = index.emplace(name, index.size());
    if (is_new) {
      names.push_back(name);
    }
    limits.push_back(found->second);
  }
  series["limit"] = std::move(limits);
  series["limit_names"] = std::move(names);
}

[[nodiscard]] inline nlohmann::json key_figure(const char* label, const std::string& value,
                                               const char* unit, const char* note) {
  return {{"label", label}, {"value", value}, {"unit", unit}, {"note", note}};
}

[[nodiscard]] inline nlohmann::json shares_list(const LimitShares& shares) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [name, share] : shares) {
    list.push_back({{"name", name}, {"share", share}});
  }
  return list;
}

/// Lines of a terminal's table.
[[nodiscard]] inline std::string shares_table(const LimitShares& shares) {
  std::string lines;
  for (const auto& [name, share] : shares) {
    lines += fmt::format("  {:<26}{:>9.1f} %\n", name, share * 100.0);
  }
  return lines;
}

}  // namespace graben::cli
