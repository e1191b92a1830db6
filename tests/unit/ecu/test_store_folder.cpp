// SPDX-License-Identifier: Apache-2.0
// A store in a folder of the system: made, missing, mounted over, full, of two processes.

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/ecu/store/folder_files.hpp"
#include "app/ecu/store/stored_faults.hpp"
#include "tests/unit/ecu/store_records.hpp"

using namespace graben::test::records;

namespace {

std::string new_folder() {
  std::string name = "/tmp/graben-store-XXXXXX";
  assert_non_null(mkdtemp(name.data()));
  return name;
}

}  // namespace

TEST(a_folder_is_made_and_its_records_are_read_again) {
  const std::string folder = new_folder();
  {
    FolderFiles files(folder + "/store");
    Store store(files, kHash);
    assert_true(write(store, kFirst, 1) && write(store, kFirst, 2));
  }
  FolderFiles files(folder + "/store", FolderFiles::Missing::kIsAnError);
  Store store(files, kHash);
  assert_int_equal(read_number(store, kFirst), 2);
  assert_true(write(store, kFirst, 3));
  assert_int_equal(read_number(store, kFirst), 3);
  std::filesystem::remove_all(folder);
}

TEST(a_folder_that_cannot_be_is_said_and_tried_again) {
  FolderFiles nowhere("/dev/null/store");
  Store store(nowhere, kHash);
  assert_true(store.read(kFirst).payload == nullptr);
  assert_false(write(store, kFirst, 1));
  assert_string_equal(store.error(), "/dev/null/store: Not a directory");
  const std::string folder = new_folder();
  FolderFiles later(folder + "/disk/store");
  Store waiting(later, kHash);
  assert_false(write(waiting, kFirst, 1));
  assert_int_equal(mkdir((folder + "/disk").c_str(), 0755), 0);
  assert_true(write(waiting, kFirst, 2));
  std::filesystem::remove_all(folder);
}

TEST(a_folder_that_is_mounted_over_is_another_place) {
  const std::string folder = new_folder();
  const std::string place = folder + "/store";
  {
    FolderFiles files(folder + "/disk");
    Store store(files, kHash);
    assert_true(write(store, kFirst, 1) && write(store, kFirst, 2) && write(store, kFirst, 3));
  }
  FolderFiles files(place);
  Store store(files, kHash);
  assert_true(store.look() == Place::kAnother && write(store, kFirst, 9));
  assert_true(store.look() == Place::kSame);
  std::filesystem::rename(place, folder + "/hidden");
  std::filesystem::rename(folder + "/disk", place);
  assert_true(store.look() == Place::kAnother);
  assert_int_equal(read_number(store, kFirst), 3);
  assert_true(write(store, kFirst, 4));
  assert_int_equal(read_number(store, kFirst), 4);
  std::filesystem::rename(folder, folder + "-gone");
  assert_true(store.look() == Place::kNone);
  assert_true(store.read(kFirst).state == ReadState::kNothing);
  assert_false(write(store, kFirst, 5));
  std::filesystem::rename(folder + "-gone", folder);
  assert_true(store.look() == Place::kAnother);
  assert_int_equal(read_number(store, kFirst), 4);
  std::filesystem::remove_all(folder);
}

TEST(of_two_that_store_in_one_folder_the_second_does_not) {
  const std::string folder = new_folder();
  auto files = std::make_unique<FolderFiles>(folder);
  Store store(*files, kHash);
  assert_true(write(store, kFirst, 1));
  FolderFiles others(folder);
  Store second(others, kHash);
  assert_true(second.look() == Place::kNone);
  assert_false(write(second, kFirst, 2));
  assert_string_equal(second.error(), (folder + "/lock: another process stores there").c_str());
  assert_true(store.look() == Place::kSame && write(store, kFirst, 3));
  // A tool reads all the same.
  FolderFiles reader(folder, FolderFiles::Missing::kIsAnError);
  Store tool(reader, kHash);
  assert_int_equal(read_number(tool, kFirst), 3);
  // Once the first one has ended, it stores, and goes on from what that has left.
  files.reset();
  assert_true(second.look() == Place::kAnother);
  assert_int_equal(read_number(second, kFirst), 3);
  assert_true(write(second, kFirst, 4));
  std::filesystem::remove_all(folder);
}

TEST(what_is_no_file_is_neither_read_nor_written) {
  const std::string folder = new_folder();
  assert_int_equal(mkfifo((folder + "/faults.a").c_str(), 0644), 0);
  assert_int_equal(symlink("/dev/full", (folder + "/frame-001.a").c_str()), 0);
  FolderFiles files(folder);
  Store store(files, kHash);
  assert_int_equal(mkdir((folder + "/faults.b").c_str(), 0755), 0);
  const std::vector<std::string> why = read_stored_faults(files).unreadable;
  assert_int_equal(why.size(), 3);
  assert_string_equal(why[0].c_str(), (folder + "/faults.a: is a pipe, no file").c_str());
  assert_string_equal(why[1].c_str(), (folder + "/faults.b: is a folder, no file").c_str());
  assert_string_equal(why[2].c_str(), (folder + "/frame-001.a: is a link, no file").c_str());
  assert_true(read_stored_faults(files).damaged.empty());
  assert_true(store.read(kFirst).state == ReadState::kDamaged);
  assert_false(write(store, kFirst, 1));
  assert_false(write(store, {RecordKind::kFreezeFrame, 1}, 1));
  std::filesystem::remove_all(folder);
}

TEST(a_disk_that_is_full_keeps_what_it_has) {
  const std::string folder = new_folder();
  FolderFiles files(folder);
  Store store(files, kHash);
  assert_true(write(store, kFirst, 1));
  rlimit before{};
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit little{40, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &little), 0);
  const bool written = write(store, kFirst, 2);
  const std::string why = store.error();
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  assert_false(written);
  assert_string_equal(why.c_str(), (folder + "/faults.b: File too large").c_str());
  assert_int_equal(read_number(store, kFirst), 1);
  assert_true(write(store, kFirst, 3));
  assert_int_equal(read_number(store, kFirst), 3);
  std::filesystem::remove_all(folder);
}
