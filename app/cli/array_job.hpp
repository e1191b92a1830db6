// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A campaign as an array job of Slurm: a task for each shard, and a job after them that puts the
/// shards together. All that is known of it is in the folder SUMMARY.slurm, so any later command,
/// on any machine that sees the folder, goes on with it.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace graben::cli {

/// What `--slurm` and `--sbatch` ask for.
struct ArrayOptions {
  unsigned shards = 0;              ///< 0: not on Slurm.
  std::vector<std::string> sbatch;  ///< Options for sbatch, as they are.
};
inline constexpr int kMostShards = 1000;  ///< Slurm's MaxArraySize unless told is 1001.

struct ArrayJob {
  std::filesystem::path summary;  ///< Absolute.
  std::string command;            ///< One shard's, for a shell, without shard, file and threads.
  std::uint64_t draws = 0;        ///< Of all shards.
  unsigned shards = 0;
  unsigned jobs = 1;  ///< Threads, and processors, of a task.
  std::vector<std::string> sbatch;
  std::vector<std::string> arrays;  ///< Slurm's ids of the array jobs so far.
  std::string merge;                ///< Of the job that comes after the last array.
  std::size_t rows_before = 0;      ///< Rows that there were when the last array was submitted.
};

[[nodiscard]] std::filesystem::path array_folder(const std::filesystem::path& summary);

/// The job of `summary`. Throws std::runtime_error where there is none.
[[nodiscard]] ArrayJob read_array_job(const std::filesystem::path& summary);

/// How far it is.
struct ArrayProgress {
  std::vector<std::size_t> rows;  ///< Of each shard.
  std::vector<unsigned> left;     ///< Shards, from 1, that lack rows.
  std::size_t all_rows = 0;
  std::size_t running = 0;  ///< Tasks that Slurm has, and what they do.
  std::size_t waiting = 0;
  std::vector<std::string> held;  ///< Tasks that Slurm holds back, for a launch that failed.
  bool is_merging = false;        ///< The merge job is in the queue.
  bool is_merged = false;

  [[nodiscard]] bool is_queued() const { return running + waiting > 0; }
};

/// Brings `job` up to date where it was submitted again meanwhile. Throws std::runtime_error where
/// a shard's file or the queue cannot be read.
[[nodiscard]] ArrayProgress progress_of(ArrayJob& job);

/// Writes the scripts and submits what is left, with the merge job after it. Throws
/// std::runtime_error with sbatch's own words where it refuses.
void submit_array(ArrayJob& job, const ArrayProgress& progress);

/// Lets those that are held go on; that one cannot, the next look shows.
void release_held(const ArrayProgress& progress);

/// With all rows there: one file in the place of `summary`, whose table is returned. Otherwise
/// submits what is left once more, and says so. Throws std::runtime_error where tasks are still in
/// the queue, or where the last array has added no row: whatever stops it, it would again.
[[nodiscard]] std::string collect_array(const std::filesystem::path& summary);

}  // namespace graben::cli
