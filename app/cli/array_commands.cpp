// SPDX-License-Identifier: Apache-2.0
#include "app/cli/array_commands.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <thread>

#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/cli/program.hpp"
#include "app/cli/program_files.hpp"

namespace graben::cli {
namespace {

namespace fs = std::filesystem;

struct ProgressCommand {
  std::string summary;
  bool wait = false;
};

/// Options that each task has of its own.
bool is_of_the_array(const std::string& option) {
  const std::vector<std::string> own = {"--slurm", "--sbatch", "--shard", "--summary", "--jobs"};
  return std::find(own.begin(), own.end(), option) != own.end();
}

std::string options_as_typed(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || is_of_the_array(option->get_name())) {
      continue;
    }
    text += " " + option->get_name();
    // A flag's result is "true"; an option that stands alone has an empty one.
    if (option->get_expected_max() > 0 && option->get_type_size() != 0) {
      for (const std::string& value : option->results()) {
        text += value.empty() ? "" : " " + shell_word(value);
      }
    }
  }
  for (const CLI::App* group : command.get_subcommands({})) {
    text += options_as_typed(*group);
  }
  return text;
}

std::string shard_command(const CLI::App& command) {
  return shell_word(graben_file().string()) + " campaign " + command.get_name() +
         options_as_typed(command);
}

/// A campaign that cannot begin is refused here, not by each task. Leaves nothing.
void try_without_draws(const runs::CampaignOptions& campaign, const fs::path& folder,
                       const std::function<void(const runs::CampaignOptions&)>& run) {
  runs::CampaignOptions none = campaign;
  none.draws = 0;
  none.summary = (folder / "none.csv").string();
  const bool is_new = fs::create_directories(folder);
  try {
    run(none);
    fs::remove(none.summary);
  } catch (...) {
    std::error_code ignored;
    fs::remove(none.summary, ignored);
    if (is_new) {
      fs::remove(folder, ignored);
    }
    throw;
  }
}

/// Where nothing was submitted yet and Slurm takes nothing, there is no campaign to go on with.
void submit_or_leave_nothing(ArrayJob& job, const ArrayProgress& progress) {
  try {
    submit_array(job, progress);
  } catch (...) {
    const fs::path folder = array_folder(job.summary);
    std::error_code ignored;
    if (job.arrays.empty() && progress.all_rows == 0) {
      for (const char* const name : {"shard.sh", "merge.sh"}) {
        fs::remove(folder / name, ignored);
      }
      fs::remove(folder, ignored);
    }
    throw;
  }
}

std::string progress_line(const ArrayJob& job, const ArrayProgress& progress) {
  return fmt::format(
      "{} of {} draws ({:.1f} %), {} of {} shards whole; tasks: {} running, {} waiting{}{}",
      progress.all_rows, job.draws,
      100.0 * static_cast<double>(progress.all_rows) / static_cast<double>(job.draws),
      job.shards - progress.left.size(), job.shards, progress.running, progress.waiting,
      progress.held.empty() ? "" : fmt::format(" ({} held)", progress.held.size()),
      progress.is_merged ? "; merged" : "");
}

/// Until it is merged. What neither runs nor waits is set going again here: a controller that was
/// killed may have forgotten jobs, the one that merges among them.
void wait_for(const std::string& summary) {
  ProgressBar bar("campaign");
  for (int idle_looks = 0;;) {
    ArrayJob job = read_array_job(summary);
    const ArrayProgress progress = progress_of(job);
    if (progress.is_merged) {
      return;
    }
    // Seen once, it may only be that the job at the end has just submitted what is left.
    idle_looks = progress.is_queued() || progress.is_merging ? 0 : idle_looks + 1;
    if (idle_looks > 1) {
      static_cast<void>(collect_array(summary));
      idle_looks = 0;
    }
    release_held(progress);
    bar.show(static_cast<double>(progress.all_rows) / static_cast<double>(job.draws),
             progress_line(job, progress));
    std::this_thread::sleep_for(std::chrono::seconds(2));
  }
}

void show_progress(const ProgressCommand& options) {
  if (options.wait) {
    wait_for(options.summary);
  }
  ArrayJob job = read_array_job(options.summary);
  const ArrayProgress progress = progress_of(job);
  fmt::print("{}\n", progress_line(job, progress));
  if (!progress.is_merged && !progress.is_queued() && !progress.is_merging) {
    throw std::runtime_error(fmt::format(
        "nothing of it is in the queue; with --wait, and by the command that submitted it, it goes "
        "on with what is left (what stopped it: {}/*.txt)",
        array_folder(options.summary).string()));
  }
}

struct MergeOptions {
  std::vector<std::string> from;
  std::string summary;
};

}  // namespace

void add_array_options(CLI::App& command, ArrayOptions& options) {
  CLI::Option* slurm =
      command
          .add_option("--slurm", options.shards,
                      "Submit it to Slurm instead, as an array job of so many shards, 1 .. 1000; "
                      "--jobs are then the processors of each, 1 unless told")
          ->check(whole_number_between(1, kMostShards))
          ->excludes(command.get_option("--shard"));
  command
      .add_option("--sbatch", options.sbatch,
                  "An option for sbatch, such as --sbatch=--partition=long; may be repeated")
      ->needs(slurm)
      ->allow_extra_args(false);
}

void submit_campaign(const CLI::App& command, const runs::CampaignOptions& campaign,
                     const ArrayOptions& options,
                     const std::function<void(const runs::CampaignOptions&)>& run) {
  for (const char* program : {"sbatch", "squeue", "scontrol"}) {
    assert_program(program, "slurm-client");
  }
  ArrayJob job;
  job.summary = fs::absolute(campaign.summary);
  if (fs::exists(job.summary)) {
    throw std::runtime_error(
        fmt::format("{}: is there already; name another file", campaign.summary));
  }
  const fs::path folder = array_folder(job.summary);
  job.command = shard_command(command);
  job.draws = campaign.draws;
  job.shards = options.shards;
  if (job.shards > job.draws) {
    throw std::runtime_error(fmt::format(
        "--slurm: {} shards of {} draws; at most one for each draw", job.shards, job.draws));
  }
  try_without_draws(campaign, folder, run);
  if (fs::exists(folder / "job.json")) {
    const ArrayJob before = read_array_job(job.summary);
    if (before.command != job.command || before.draws != job.draws || before.shards != job.shards) {
      throw std::runtime_error(
          fmt::format("{}: is of another campaign; name another --summary", folder.string()));
    }
    job = before;
  }
  const ArrayProgress progress = progress_of(job);
  if (progress.is_queued() || progress.is_merging) {
    throw std::runtime_error(
        fmt::format("it is in the queue already; graben campaign progress {} follows it",
                    shell_word(campaign.summary)));
  }
  job.jobs = std::max(1U, campaign.jobs);
  job.sbatch = options.sbatch;
  if (progress.left.empty()) {
    fmt::print("{}", collect_array(job.summary));
    return;
  }
  submit_or_leave_nothing(job, progress);
  fmt::print("submitted job {}: {} draws in {} shards; then job {}, which merges them into {}\n",
             job.arrays.back(), job.draws - progress.all_rows, progress.left.size(), job.merge,
             campaign.summary);
  fmt::print("progress: graben campaign progress {}\n", shell_word(campaign.summary));
}

void add_campaign_progress(CLI::App& campaign, int& status) {
  auto options = std::make_shared<ProgressCommand>();
  CLI::App* command =
      campaign.add_subcommand("progress", "How far a campaign on Slurm is, and what its tasks do");
  command->add_option("summary", options->summary, "The CSV that it is to write")->required();
  command->add_flag("--wait", options->wait,
                    "Until it is merged; sets going again what Slurm has forgotten; exit status 1 "
                    "if nothing comes of it");
  add_examples(*command, {"campaign progress out/draws.csv --wait"});
  command->callback([options, &status] {
    status = guarded("campaign progress", [&] { show_progress(*options); });
  });
}

void add_campaign_collect(CLI::App& campaign, int& status) {
  auto summary = std::make_shared<std::string>();
  CLI::App* command = campaign.add_subcommand(
      "collect",
      "What the last job of a campaign on Slurm does: merges its shards, or submits once more what "
      "they lack");
  command->add_option("summary", *summary, "The CSV that it is to write")->required();
  add_examples(*command, {"campaign collect out/draws.csv"});
  command->callback([summary, &status] {
    status = guarded("campaign collect", [&] { fmt::print("{}", collect_array(*summary)); });
  });
}

void add_campaign_merge(CLI::App& campaign, int& status) {
  auto options = std::make_shared<MergeOptions>();
  CLI::App* command = campaign.add_subcommand("merge", "Shards of one campaign into one file");
  command->add_option("files", options->from, "CSV files of the shards")->required();
  command->add_option("--summary", options->summary, "CSV to write")->required();
  add_examples(*command, {"campaign merge shard1.csv shard2.csv --summary all.csv"});
  command->callback([options, &status] {
    status = guarded("campaign merge", [&] {
      fmt::print("{}", runs::merge_campaigns(options->from, options->summary));
    });
  });
}

}  // namespace graben::cli
