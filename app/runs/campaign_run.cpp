// SPDX-License-Identifier: Apache-2.0
#include "app/runs/campaign_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace graben::runs {
namespace {

/// Set by SIGINT and SIGTERM: runs that have begun are finished, no more are begun.
std::atomic<bool> interrupted{false};
std::atomic<int> interrupted_by{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void interrupt(int signal) {
  interrupted_by = signal;
  interrupted = true;
}

constexpr std::uint64_t kMostSeed = 999999999999999999;  // What a file's seed may have.

struct Shard {
  std::uint64_t index;
  std::uint64_t count;
};

Shard shard_of(const std::string& text) {
  const std::size_t slash = text.find('/');
  const auto number = [&](const std::string& part) {
    const bool digits = !part.empty() && part.size() <= 9 &&
                        part.find_first_not_of("0123456789") == std::string::npos;
    return digits ? std::stoull(part) : 0;
  };
  const Shard shard = {number(text.substr(0, slash)),
                       slash == std::string::npos ? 0 : number(text.substr(slash + 1))};
  if (shard.count == 0 || shard.index == 0 || shard.index > shard.count) {
    throw std::runtime_error(
        fmt::format("--shard: '{}'; allowed: i/n with i from 1 to n, as in 2/8", text));
  }
  return shard;
}

/// Draws the seeds that the log lacks, on `jobs` threads.
class Campaign {
 public:
  Campaign(const CampaignDraw& draw, CampaignLog& log, std::vector<std::uint64_t> seeds,
           const Progress& progress)
      : draw_(draw), log_(log), seeds_(std::move(seeds)), progress_(progress) {}

  void run(unsigned jobs) {
    std::vector<std::thread> threads;
    try {
      for (std::size_t i = 0; i < std::min<std::size_t>(jobs, seeds_.size()); ++i) {
        threads.emplace_back([this] { work(); });
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      failure_ = std::current_exception();
      interrupted = true;
    }
    for (std::thread& thread : threads) {
      thread.join();
    }
    if (failure_) {
      std::rethrow_exception(failure_);
    }
  }

 private:
  void work() {
    while (!interrupted) {
      const std::size_t index = next_++;
      if (index >= seeds_.size()) {
        return;
      }
      try {
        const CampaignRow row = draw_(seeds_[index]);
        const std::lock_guard<std::mutex> lock(mutex_);
        if (failure_) {
          return;  // What a full disk has cut short must stay the last line.
        }
        log_.add(seeds_[index], row);
        ++done_;
        progress_(static_cast<double>(done_) / static_cast<double>(seeds_.size()),
                  fmt::format("{} of {} draws", done_, seeds_.size()));
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex_);
        failure_ = std::current_exception();
        interrupted = true;
      }
    }
  }

  const CampaignDraw& draw_;
  CampaignLog& log_;
  std::vector<std::uint64_t> seeds_;
  const Progress& progress_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::exception_ptr failure_;
};

/// Those of the shard that the log lacks.
std::vector<std::uint64_t> seeds_left(const CampaignOptions& options, const CampaignLog& log) {
  const Shard shard = shard_of(options.shard);
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t n = shard.index - 1; n < options.draws; n += shard.count) {
    if (!log.has(options.seed + n)) {
      seeds.push_back(options.seed + n);
    }
  }
  return seeds;
}

}  // namespace

std::size_t shard_size(const CampaignOptions& options) {
  const Shard shard = shard_of(options.shard);
  return shard.index > options.draws ? 0 : 1 + (options.draws - shard.index) / shard.count;
}

CampaignOutcome run_campaign(const CampaignOptions& options, const CampaignKind& kind,
                             const std::string& tried, const CampaignDraw& draw,
                             const Progress& progress) {
  static_cast<void>(shard_of(options.shard));  // Wrong options before the file is touched.
  if (options.seed > kMostSeed - options.draws) {
    throw std::runtime_error(
        fmt::format("--seed and --draws: the last seed is more than {}", kMostSeed));
  }
  CampaignLog log(options.summary, kind, tried);
  const std::size_t asked = shard_size(options);
  std::vector<std::uint64_t> seeds = seeds_left(options, log);
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  const unsigned jobs =
      options.jobs > 0 ? options.jobs : std::max(1U, std::thread::hardware_concurrency());
  Campaign(draw, log, std::move(seeds), progress).run(jobs);
  write_campaign(options.summary, kind, log.data());
  CampaignOutcome outcome;
  outcome.signal = interrupted_by;
  outcome.table = campaign_table(kind, log.data(), asked);
  const auto failed =
      std::count_if(log.data().rows.begin(), log.data().rows.end(),
                    [&](const auto& row) { return row.second.end >= kind.failures_from; });
  if (failed > 0) {
    outcome.error = fmt::format("{} draws did not come to their end", failed);
  }
  if (interrupted) {
    const std::size_t left = seeds_left(options, log).size();
    outcome.error += fmt::format(
        "{}interrupted with {} of {} draws done; the same command goes on with what {} lacks",
        outcome.error.empty() ? "" : "; ", asked - left, asked, options.summary);
  }
  return outcome;
}

}  // namespace graben::runs
