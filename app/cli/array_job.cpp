// SPDX-License-Identifier: Apache-2.0
#include "app/cli/array_job.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "app/cli/output_file.hpp"
#include "app/cli/program.hpp"
#include "app/cli/program_files.hpp"
#include "app/machines/missing_file.hpp"
#include "app/runs/campaign_run.hpp"

namespace graben::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "job.json";
constexpr int kPatience = 40;  // A controller that is restarted is away for minutes.
constexpr std::chrono::seconds kBetween(15);

fs::path shard_file(const ArrayJob& job, unsigned shard) {
  return array_folder(job.summary) / fmt::format("shard-{}.csv", shard);
}

void write_job(const ArrayJob& job) {
  const nlohmann::ordered_json json = {{"command", job.command}, {"draws", job.draws},
                                       {"shards", job.shards},   {"jobs", job.jobs},
                                       {"sbatch", job.sbatch},   {"arrays", job.arrays},
                                       {"merge", job.merge},     {"rows_before", job.rows_before}};
  write_whole(array_folder(job.summary) / kFile, json.dump(2) + "\n");
}

/// What is killed from outside (for its memory, by hand) is done again elsewhere, from the row
/// where it stopped. A node that is lost is Slurm's own to requeue.
std::string shard_script(const ArrayJob& job) {
  return fmt::format(
      "#!/bin/sh\n"
      "# One shard of a campaign, as a task of an array job. Written by graben.\n"
      "{} --shard \"$SLURM_ARRAY_TASK_ID/{}\" --jobs {} \\\n"
      "  --summary {}/\"shard-$SLURM_ARRAY_TASK_ID.csv\"\n"
      "status=$?\n"
      "if [ \"$status\" -gt 128 ] && [ \"${{SLURM_RESTART_COUNT:-0}}\" -lt 100 ]; then\n"
      "  scontrol requeue \"$SLURM_JOB_ID\" && sleep 60\n"
      "fi\n"
      "exit \"$status\"\n",
      job.command, job.shards, job.jobs, shell_word(array_folder(job.summary).string()));
}

std::string merge_script(const ArrayJob& job) {
  return fmt::format(
      "#!/bin/sh\n"
      "# After all tasks: the shards as one file, or what is left once more. Written by graben.\n"
      "unset SLURM_RESTART_COUNT\n"
      "exec {} campaign collect {}\n",
      shell_word(graben_file().string()), shell_word(job.summary.string()));
}

/// sbatch reads a '%' in a file's name as the begin of a pattern.
std::string pattern(const fs::path& file) {
  std::string text;
  for (const char letter : file.string()) {
    text += letter == '%' ? std::string("%%") : std::string(1, letter);
  }
  return text;
}

/// Runs a client of Slurm; while its controller is away, again and again where there is patience.
std::string ask_slurm(const std::vector<std::string>& words, int patience) {
  for (int attempt = 0;; ++attempt) {
    const ProgramOutcome outcome = run_program(words);
    if (outcome.status == 0) {
      return outcome.out;
    }
    if (attempt >= patience) {
      throw std::runtime_error(fmt::format("{} (status {}): {}", words.front(), outcome.status,
                                           outcome.err.substr(0, outcome.err.find('\n'))));
    }
    std::this_thread::sleep_for(kBetween);
  }
}

/// The new job's id. `--parsable` has a cluster's name behind it where there are several.
std::string submit(const ArrayJob& job, const std::vector<std::string>& options, const char* script,
                   int patience) {
  const fs::path folder = array_folder(job.summary);
  std::vector<std::string> words = {"sbatch", "--parsable", "--requeue", "--open-mode=append",
                                    "--job-name=graben-" + job.summary.stem().string()};
  words.insert(words.end(), options.begin(), options.end());
  words.insert(words.end(), job.sbatch.begin(), job.sbatch.end());
  words.push_back((folder / script).string());
  const std::string said = ask_slurm(words, patience);
  const std::string id = said.substr(0, said.find_first_not_of("0123456789"));
  if (id.empty()) {
    throw std::runtime_error(fmt::format("sbatch: names no job: '{}'", said));
  }
  return id;
}

bool is_inside_slurm() { return std::getenv("SLURM_JOB_ID") != nullptr; }

void read_queue(const ArrayJob& job, ArrayProgress& progress) {
  if (job.arrays.empty()) {
    return;
  }
  std::istringstream queue(ask_slurm({"squeue", "--noheader", "--array", "--format=%F %K %T %r"},
                                     is_inside_slurm() ? kPatience : 0));
  for (std::string line; std::getline(queue, line);) {
    std::istringstream words(line);
    std::string id;
    std::string task;
    std::string state;
    words >> id >> task >> state;
    if (id == job.merge) {
      progress.is_merging = true;
    } else if (std::count(job.arrays.begin(), job.arrays.end(), id) > 0) {
      ++(state == "PENDING" ? progress.waiting : progress.running);
      if (line.find("held") != std::string::npos) {
        progress.held.push_back(id + "_" + task);
      }
    }
  }
}

/// What stopped it, as far as it has been said.
std::string last_words(const ArrayJob& job, unsigned shard) {
  std::ifstream stream(array_folder(job.summary) / fmt::format("shard-{}.txt", shard));
  std::string last;
  for (std::string line; std::getline(stream, line);) {
    last = line.empty() ? last : line;
  }
  return last.empty() ? "it said nothing" : last;
}

}  // namespace

fs::path array_folder(const fs::path& summary) { return summary.string() + ".slurm"; }

ArrayJob read_array_job(const fs::path& summary) {
  const fs::path file = array_folder(fs::absolute(summary)) / kFile;
  std::ifstream stream(file);
  if (!stream) {
    throw std::runtime_error(
        machines::unread_text(file, fmt::format("a campaign on a cluster; graben campaign ... "
                                                "--slurm --summary {} begins one",
                                                summary.string())));
  }
  const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
  ArrayJob job;
  try {
    job.summary = fs::absolute(summary);
    json.at("command").get_to(job.command);
    json.at("draws").get_to(job.draws);
    json.at("shards").get_to(job.shards);
    json.at("jobs").get_to(job.jobs);
    json.at("sbatch").get_to(job.sbatch);
    json.at("arrays").get_to(job.arrays);
    json.at("merge").get_to(job.merge);
    json.at("rows_before").get_to(job.rows_before);
  } catch (const nlohmann::json::exception&) {
    throw std::runtime_error(fmt::format("{}: is not what graben writes there", file.string()));
  }
  return job;
}

ArrayProgress progress_of(ArrayJob& job) {
  ArrayProgress progress;
  // The queue before the rows: what has left it by now has written all that it will.
  for (bool is_same = false; !is_same;) {
    progress = {};
    read_queue(job, progress);
    // The job at the end may have submitted what was left, and gone, since `job` was read.
    const bool is_there = fs::exists(array_folder(job.summary) / kFile);
    const ArrayJob now = is_there ? read_array_job(job.summary) : job;
    is_same = now.arrays == job.arrays && now.merge == job.merge;
    job = now;
  }
  for (unsigned shard = 1; shard <= job.shards; ++shard) {
    runs::CampaignOptions options;
    options.draws = job.draws;
    options.shard = fmt::format("{}/{}", shard, job.shards);
    const std::size_t rows = runs::campaign_rows(shard_file(job, shard).string());
    progress.rows.push_back(rows);
    progress.all_rows += rows;
    if (rows < runs::shard_size(options)) {
      progress.left.push_back(shard);
    }
  }
  progress.is_merged = fs::exists(job.summary);
  return progress;
}

void submit_array(ArrayJob& job, const ArrayProgress& progress) {
  const fs::path folder = array_folder(job.summary);
  const int patience = is_inside_slurm() ? kPatience : 0;
  write_whole(folder / "shard.sh", shard_script(job));
  write_whole(folder / "merge.sh", merge_script(job));
  job.rows_before = progress.all_rows;
  job.arrays.push_back(submit(job,
                              {fmt::format("--array={}", fmt::join(progress.left, ",")),
                               fmt::format("--cpus-per-task={}", job.jobs),
                               "--output=" + pattern(folder / "shard-") + "%a.txt"},
                              "shard.sh", patience));
  write_job(job);
  job.merge = submit(
      job,
      {"--dependency=afterany:" + job.arrays.back(), "--output=" + pattern(folder / "merge.txt")},
      "merge.sh", patience);
  write_job(job);
}

void release_held(const ArrayProgress& progress) {
  for (const std::string& task : progress.held) {
    static_cast<void>(run_program({"scontrol", "release", task}));
  }
}

std::string collect_array(const fs::path& summary) {
  ArrayJob job = read_array_job(summary);
  const runs::FileLock lock(array_folder(job.summary) / "collect.lock");
  ArrayProgress progress = progress_of(job);
  // A node may still be clearing up after the last task when the merge job begins.
  for (int attempt = 0; is_inside_slurm() && progress.is_queued() && attempt < kPatience;
       ++attempt) {
    std::this_thread::sleep_for(kBetween);
    progress = progress_of(job);
  }
  if (progress.is_queued()) {
    throw std::runtime_error(fmt::format(
        "{} of its tasks are still in the queue; graben campaign progress {} follows them",
        progress.running + progress.waiting, shell_word(summary.string())));
  }
  if (!progress.left.empty()) {
    if (progress.all_rows <= job.rows_before) {
      throw std::runtime_error(fmt::format(
          "{} of {} draws, and the last {} tasks have added none; shard {} ended with: {}",
          progress.all_rows, job.draws, progress.left.size(), progress.left.front(),
          last_words(job, progress.left.front())));
    }
    submit_array(job, progress);
    return fmt::format("{} of {} draws; submitted again: shards {}\n", progress.all_rows, job.draws,
                       fmt::join(progress.left, ","));
  }
  std::vector<std::string> files;
  for (unsigned shard = 1; shard <= job.shards; ++shard) {
    files.push_back(shard_file(job, shard).string());
  }
  return runs::merge_campaigns(files, job.summary.string());
}

}  // namespace graben::cli
