// SPDX-License-Identifier: Apache-2.0
// Logs of other tools: as python-can 4.1 writes the same four frames, and as others vary it.

#include "app/identify/machine/candump_reader.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/design/written_file.hpp"

using test::has;

struct Read {
  identify::LogRead read;
  std::vector<identify::LoggedFrame> frames;
};

Read read(const std::string& name, const std::string& text) {
  const test::WrittenFile file(name, text);
  Read all;
  all.read = identify::read_candump(
      file.path(), [&](const identify::LoggedFrame& frame) { all.frames.push_back(frame); });
  return all;
}

/// A frame of ours at the begin, one of eleven bits 10 ms later; a remote and an FD one are passed
/// over.
void assert_both(const Read& all) {
  assert_int_equal(all.frames.size(), 2);
  assert_true(all.read.notes().empty());
  const identify::LoggedFrame& first = all.frames[0];
  assert_int_equal(first.id, 0x0CFF2080);
  assert_true(first.extended);
  assert_true(first.data == dbc::Payload({0x34, 0xFA, 0x38, 0x54, 0xFF, 0xFF, 0xFF, 0xFF}));
  const identify::LoggedFrame& second = all.frames[1];
  assert_int_equal(second.id, 0x123);
  assert_false(second.extended);
  assert_int_equal(second.length, 2);
  assert_int_equal(second.data[1], 2);
  assert_near(second.time_s - first.time_s, 0.01, 1e-6);
}

TEST(asc_is_read) {
  const std::string begin = "date Sun Nov 29 01:00:53.359 PM 2026\r\n";
  assert_both(read(
      "a.asc",
      begin +
          "base hex  timestamps absolute\ninternal events logged\n"
          "Begin Triggerblock Thu Nov 27 11:00:04.0 PM 2025\n 0.000000 Start of measurement\n"
          " 0.000000 1  CFF2080x        Rx   d 8 34 FA 38 54 FF FF FF FF\n"
          " 0.010000 1  123             Rx   d 2 01 02\n 0.020000 1  123             Rx   r 0 \n"
          " 0.030000 CANFD   1 Rx   18FF2080x   0 0 9 12 00 00 00 00 00 00 00 00 00 00 00 00 0\n"
          "End TriggerBlock\n"));
  // Decimal, by steps, with what CANoe adds; the ending says nothing.
  assert_both(read("a.log",
                   "base dec  timestamps relative\n// version 9.0.0\n"
                   "   1.500000 1  218046592x  Tx   d 8  52 250  56  84 255 255 255 255  Length = "
                   "0 BitCount = 0\n"
                   "   0.005000 1  ErrorFrame\n   0.005000 2  291  Rx   d 2   1   2\n"));
  assert_true(
      has(read("a.asc", begin + " 0.1 1 12Gx Rx d 1 00\n 0.2 1 123 Rx d 1 00\n").read.notes()[0],
          "1 line is none of ASC's, left out; the first is line 2"));
}

TEST(trc_is_read) {
  assert_both(read(
      "a.trc",
      ";$FILEVERSION=2.1\n;$STARTTIME=66775.4\n;$COLUMNS=N,O,T,B,I,d,R,L,D\n;\n"
      "      0         0.000 DT  1  CFF2080 Rx -  8    34 FA 38 54 FF FF FF FF\n"
      "      1        10.000 DT  1     0123 Rx -  2    01 02\n"
      "      2        20.000 RR  1     0123 Rx -  2\n      3        21.000 ST  1        - Rx -  4  "
      "  00 00 00 08\n"
      "      4        22.000 FD  1 18FF2080 Rx -  9    00 01 02 03 04 05 06 07 08 09 0A 0B\n"));
  assert_both(read("b.trc",
                   ";$FILEVERSION=2.0\n;$COLUMNS=N,O,T,I,d,l,D\n"
                   "      1         0.000 DT 0CFF2080 Rx 8  34 FA 38 54 FF FF FF FF\n      2       "
                   " 10.000 DT     0123 Tx 2  01 02\n"));
  assert_both(read("c.trc",
                   ";$FILEVERSION=1.3\n     1)         0.000 1  Rx     0CFF2080 -  8    34 FA 38 "
                   "54 FF FF FF FF\n"
                   "     2)        10.000 1  Rx         0123 -  2    01 02\n     3)     11.0 1  "
                   "Warng  FFFFFFFF -  4    00 00 00 08\n"));
  assert_both(read(
      "d.trc",
      ";$FILEVERSION=1.1\n     1)      0.0  Rx     0CFF2080  8  34 FA 38 54 FF FF FF FF\n"
      "     2)     10.0  Rx         0123  2  01 02\n     3)     20.0  Rx         0123  8  RTR\n"));
  assert_both(
      read("e.trc",
           ";##########\n;   PCAN-View\n     1)      0 0CFF2080  8  34 FA 38 54 FF FF FF FF\n"
           "     2)     10 0123  2  01 02\n"));
}

std::string small_blf() {
  const std::string hex =
      "4C4F47479000000005000000020608010E01000000000000B4010000000000000400000000000000E9070B000400"
      "1B001700000004000000E9070B0004001B001700000004001E000000000000000000000000000000000000000000"
      "00000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000"
      "0000000000004C4F424A100001007D0000000A00000002000000000000000401000000000000789CF3F177F25260"
      "606430606000920C0C4C0CA80028C6D1A0F0BFC7E49745C87F20F0C1A1BE6CDA0C987A266520C10895C0A5FE8D8E"
      "2123447D03833223C23E98FA12203B05497DF2E19350F50C9C40F7402DE361A0060000054C167900";
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  }
  return bytes;
}

TEST(blf_is_read) {
  const std::string bytes = small_blf();
  assert_both(read("a.blf", bytes));
  const auto refusal = [](const std::string& text) {
    return test::refusal_of([&] { static_cast<void>(read("a.blf", text)); });
  };
  assert_true(has(refusal(bytes.substr(0, 200)), "a.blf: is cut off in its last container (BLF)"));
  std::string damaged = bytes;
  damaged[200] = static_cast<char>(damaged[200] ^ 0x55);
  assert_true(has(refusal(damaged), "a container that can't be unpacked (BLF)"));
}

TEST(what_is_not_read_is_refused_with_its_kind) {
  const auto refusal = [](const std::string& text) {
    return test::refusal_of([&] { static_cast<void>(read("a.log", text)); });
  };
  assert_true(
      has(refusal("MDF     4.10"), "a.log: is an MDF (.mf4); allowed: candump, ASC, TRC or BLF"));
  assert_true(has(refusal("\x89MCAP0\r\n"), "is an MCAP"));
  assert_true(has(refusal("\xD4\xC3\xB2\xA1\x02"), "is a capture of packets"));
  assert_true(has(refusal(std::string("\xFF\xFE(\0"
                                      "1\0.\0",
                                      8)),
                  "is UTF-16; allowed: UTF-8"));
}

/// The page reads candump's lines alone.
TEST(another_log_turns_into_candumps) {
  const test::WrittenFile file("a.asc",
                               "base hex  timestamps absolute\n 1.5 1 CFF2080x Rx d 1 34\n"
                               " 1.6 1 12Gx Rx d 1 00\n 1.7 1 CFF2080x Rx d 1 35\n");
  assert_true(identify::is_other_log(file.path()));
  identify::LogRead read_of_it;
  assert_true(identify::candump_text(file.path(), &read_of_it) ==
              "(1.500000) can0 0CFF2080#34\n(1.700000) can0 0CFF2080#35\n");
  assert_int_equal(read_of_it.notes().size(), 1);
  const test::WrittenFile own("a.log", "\xEF\xBB\xBF(1.5) can0 123#00\n");
  assert_false(identify::is_other_log(own.path()));
  assert_int_equal(read("b.log", "\xEF\xBB\xBF(1.5) can0 123#00\n").frames.size(), 1);
}
