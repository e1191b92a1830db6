#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <csignal>
#include <exception>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "app/cli/campaign_file.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/guarded.hpp"
#include "app/cli/progress_bar.hpp"
#include "app/cli/scenario_options.hpp"
#include "app/cli/validators.hpp"

namespace graben::cli {
namespace {

struct Options {
  ScenarioOptions scenario;
  std::string profile = "excavator_22t";
  std::uint64_t draws = 200;
  std::uint64_t seed = 1;
  double speed = 1.0;
  std::string shard = "1/1";
  std::string summary;
  unsigned jobs = 0;
};

struct MergeOptions {
  std::vector<std::string> from;
  std::string summary;
};

/// Set by SIGINT and SIGTERM: runs that have begun are finished, no more are begun.
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void interrupt(int /*signal*/) { interrupted = true; }

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

CampaignRow run_draw(const Options& options, const machines::ExcavatorMachine& nominal,
                     std::uint64_t seed) {
  ScenarioOptions scenario = options.scenario;
  scenario.scenario.seed = seed;
  const machines::ExcavatorMachine machine = arranged(nominal, scenario);
  DigOptions dig = usual_run(machine, scenario);
  dig.speed_override_ratio = options.speed;
  const DigResult result = run_dig(machine, dig, [](double, const std::string&) {});
  const DigSummary summary = summarise(result);
  CampaignRow row;
  row.end = result.end;
  // A run that did not come round has no figures: 0 mm would be the best of all.
  row.figure.fill(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < kCampaignColumns && result.end == DigEnd::kDone; ++i) {
    row.figure[i] = campaign_columns()[i].of(summary);
  }
  return row;
}

/// Draws the seeds that the log lacks, on `jobs` threads.
class Campaign {
 public:
  Campaign(const Options& options, const machines::ExcavatorMachine& nominal, CampaignLog& log,
           std::vector<std::uint64_t> seeds)
      : options_(options), nominal_(nominal), log_(log), seeds_(std::move(seeds)) {}

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
        const CampaignRow row = run_draw(options_, nominal_, seeds_[index]);
        const std::lock_guard<std::mutex> lock(mutex_);
        if (failure_) {
          return;  // What a full disk has cut short must stay the last line.
        }
        log_.add(seeds_[index], row);
        ++done_;
        bar_.show(static_cast<double>(done_) / static_cast<double>(seeds_.size()),
                  fmt::format("{} of {} draws", done_, seeds_.size()));
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex_);
        failure_ = std::current_exception();
        interrupted = true;
      }
    }
  }

  const Options& options_;
  const machines::ExcavatorMachine& nominal_;
  CampaignLog& log_;
  std::vector<std::uint64_t> seeds_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::exception_ptr failure_;
  ProgressBar bar_{"campaign"};
};

void campaign_dig(const Options& options) {
  const Shard shard = shard_of(options.shard);
  if (options.seed > kMostSeed - options.draws) {
    throw std::runtime_error(
        fmt::format("--seed and --draws: the last seed is more than {}", kMostSeed));
  }
  const machines::ExcavatorMachine nominal =
      machines::load_excavator(machines::find_profile(options.profile));
  CampaignLog log(options.summary,
                  fmt::format("dig {} {:08x}, speed {}, {}", nominal.name, nominal.hash,
                              options.speed, scenario_words(options.scenario)));
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t n = shard.index - 1; n < options.draws; n += shard.count) {
    if (!log.has(options.seed + n)) {
      seeds.push_back(options.seed + n);
    }
  }
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  const unsigned jobs =
      options.jobs > 0 ? options.jobs : std::max(1U, std::thread::hardware_concurrency());
  Campaign(options, nominal, log, std::move(seeds)).run(jobs);
  write_campaign(options.summary, log.data());
  fmt::print("{}", campaign_table(log.data()));
  const auto failed =
      std::count_if(log.data().rows.begin(), log.data().rows.end(),
                    [](const auto& row) { return row.second.end != DigEnd::kDone; });
  if (failed > 0) {
    throw std::runtime_error(fmt::format("{} draws did not come round", failed));
  }
  if (interrupted) {
    throw std::runtime_error(
        fmt::format("interrupted; the same command goes on with what {} lacks", options.summary));
  }
}

void merge(const MergeOptions& options) {
  CampaignData all;
  for (const std::string& file : options.from) {
    const CampaignData part = read_campaign(file);
    if (!all.tried.empty() && part.tried != all.tried) {
      throw std::runtime_error(
          fmt::format("{}: holds another campaign ('{}', not '{}')", file, part.tried, all.tried));
    }
    all.tried = part.tried;
    for (const auto& [seed, row] : part.rows) {
      if (!all.rows.emplace(seed, row).second) {
        throw std::runtime_error(fmt::format("{}: seed {} is in two files", file, seed));
      }
    }
  }
  write_campaign(options.summary, all);
  fmt::print("{}", campaign_table(all));
}

void add_campaign_dig(CLI::App& campaign, int& status) {
  auto options = std::make_shared<Options>();
  CLI::App* command = campaign.add_subcommand(
      "dig", "Many draws of what the controller does not know; goes on where it was interrupted");
  command->add_option("--profile", options->profile, "Machine profile: file or shipped name")
      ->capture_default_str();
  command->add_option("--draws", options->draws, "How many, 1 .. 1000000")
      ->check(whole_number() & CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of the first draw; each next has the next")
      ->check(whole_number())
      ->capture_default_str();
  command->add_option("--shard", options->shard, "i/n: every n-th draw from the i-th on")
      ->capture_default_str();
  command->add_option("--summary", options->summary, "CSV, a row for each draw")->required();
  command->add_option("--jobs", options->jobs, "Threads, 1 .. 256; all cores unless told")
      ->check(whole_number() & CLI::Range(1, 256));
  command->add_option("--speed", options->speed, "Operator's speed override, 0.05 .. 1")
      ->check(number_between(0.05, 1.0))
      ->capture_default_str();
  options->scenario.errors = "all";
  add_scenario_options(*command, options->scenario);
  command->callback(
      [options, &status] { status = guarded("campaign dig", [&] { campaign_dig(*options); }); });
}

void add_campaign_merge(CLI::App& campaign, int& status) {
  auto options = std::make_shared<MergeOptions>();
  CLI::App* command = campaign.add_subcommand("merge", "Shards of one campaign into one file");
  command->add_option("files", options->from, "CSV files of the shards")->required();
  command->add_option("--summary", options->summary, "CSV to write")->required();
  command->callback(
      [options, &status] { status = guarded("campaign merge", [&] { merge(*options); }); });
}

}  // namespace

void add_campaign(CLI::App& app, int& status) {
  CLI::App* campaign = app.add_subcommand("campaign", "Many runs and their distribution");
  campaign->require_subcommand(1);
  add_campaign_dig(*campaign, status);
  add_campaign_merge(*campaign, status);
}

}  // namespace graben::cli
