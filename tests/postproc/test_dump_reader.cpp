// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cli/frame_choice.h"
#include "io/dump_reader.h"
#include "io/input_error.h"
#include "io/rods.h"
#include "measures/rod_quantity.h"
#include "read_dump_bytes.h"
#include "scratch_folder.h"
#include "solid/capsule_measures.h"
#include "test_bed.h"

namespace spherocylinder {
namespace {

const std::string kHeader =
    "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n0 10\n";
const std::string kColumns =
    "ITEM: ATOMS id type x y z shapex shapey shapez quat1 quat2 quat3 quat4 \n";
const std::string kRow1 = "1 1 0 0 0.5 0.01 0.01 0.1 1 0 0 0 \n";
const std::string kRow2 = "2 3 0.1 0.2 0.3 0.01 0.01 0.1 0.707107 0 0.707107 0 \n";

// Compressed by zlib in the format of gzip(1).
std::string gzip(const std::string &text, const std::string &path)
{
  const gzFile file = gzopen(path.c_str(), "wb");
  EXPECT_EQ(gzwrite(file, text.data(), static_cast<unsigned>(text.size())),
            static_cast<int>(text.size()));
  EXPECT_EQ(gzclose(file), Z_OK);
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

class DumpReaderTest : public ScratchFolder {
 protected:
  DumpFrame frame_of(const std::string &text)
  {
    DumpReader reader(write("a.dump", text));
    DumpFrame frame;
    EXPECT_TRUE(reader.next(frame));
    return frame;
  }

  std::vector<Rod> rods(const std::string &text) { return rods_of(frame_of(text)); }

  // The sentence of the error that reading all of the text gives.
  std::string error(const std::string &text)
  {
    try {
      DumpReader reader(write("a.dump", text));
      DumpFrame frame;
      while (reader.next(frame)) rods_of(frame);
    } catch (const InputError &error) {
      return error.what();
    }
    return "no error";
  }

  void expect_error(const std::string &text, const std::string &line, const std::string &what)
  {
    const std::string found = error(text);
    EXPECT_NE(found.find("a.dump" + line), std::string::npos) << found;
    EXPECT_NE(found.find(what), std::string::npos) << found;
    EXPECT_EQ(found.find('\n'), std::string::npos) << found;
  }
};

TEST_F(DumpReaderTest, ReadsRods)
{
  const auto found = rods(kHeader + kColumns + kRow1 + kRow2);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].id, 1);
  EXPECT_EQ(found[1].type, 3);
  EXPECT_EQ(found[1].capsule.segment.centre.y, 0.2);
  EXPECT_DOUBLE_EQ(found[1].capsule.segment.half_length, 0.09);  // shapez - shapex
  EXPECT_EQ(found[1].capsule.radius, 0.01);
  EXPECT_NEAR(found[0].capsule.segment.axis.z, 1.0, 1e-15);  // no turn: the axis is z
  EXPECT_NEAR(found[1].capsule.segment.axis.x, 1.0, 1e-15);  // 90 degrees about y: z becomes x
}

// `dump local` has rows without an id, which need not differ.
TEST_F(DumpReaderTest, ReadsEntries)
{
  const std::string text =
      "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ENTRIES\n2\nITEM: BOX BOUNDS pp ff ff\n-1 1\n-1 1\n0 1\n"
      "ITEM: ENTRIES c_pairs[1] c_pairs[2] \n4 0.5 \n4 0.5 \n";
  DumpReader reader(write("a.local", text), DumpKind::Entries);
  DumpFrame frame;
  ASSERT_TRUE(reader.next(frame));
  EXPECT_EQ(frame.rows, 2u);
  EXPECT_EQ(frame.value(1, 1), 0.5);
  EXPECT_FALSE(reader.next(frame));
  expect_error(text, ":3: ", "wanted 'ITEM: NUMBER OF ATOMS'");
  DumpReader cut(write("a.local", text.substr(0, text.size() - 7)), DumpKind::Entries);
  EXPECT_THROW(cut.next(frame), InputError);
}

TEST_F(DumpReaderTest, ColumnsInAnyOrderAndExtraOnes)
{
  const DumpFrame frame =
      frame_of(kHeader + "ITEM: ATOMS quat4 c_contacts element z y x shapez quat1 quat3 "
                         "quat2 shapex id\n0 4 Al 3 2 1 0.1 1 0 0 0.01 5\n"
                         "0 6 Fe 3 2 1 0.1 1 0 0 0.01 6\n");
  const auto found = rods_of(frame);
  EXPECT_EQ(found[0].capsule.segment.centre.x, 1.0);
  EXPECT_EQ(found[0].id, 5);
  EXPECT_EQ(found[0].type, 1);
  EXPECT_EQ(frame.value(1, *frame.find_column("c_contacts")), 6.0);
  EXPECT_FALSE(frame.find_column("element"));
  EXPECT_EQ(rod_quantity(frame, found, "contacts").values[1], 6.0);
}

TEST_F(DumpReaderTest, CarriageReturnsTabsBlankEndsAndTime)
{
  std::string text = kHeader + "ITEM: TIME\n0.25\n" + kColumns + kRow1 + kRow2 + "\n\n";
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
    text.insert(at, "\r");
  const DumpFrame frame = frame_of(text);
  EXPECT_EQ(frame.step, 7);
  EXPECT_EQ(frame.time, 0.25);
  EXPECT_EQ(frame.rows, 2u);
  EXPECT_EQ(frame.box[2][1], 10.0);
  EXPECT_EQ(error(text), "no error");
}

TEST_F(DumpReaderTest, GzipIsToldByItsBytesNotItsName)
{
  const std::string text = kHeader + kColumns + kRow1 + kRow2;
  const std::string packed = gzip(text, path("packed"));
  ASSERT_EQ(packed.substr(0, 2), "\x1f\x8b");
  EXPECT_EQ(rods(packed)[1].capsule.segment.centre.y, 0.2);
  EXPECT_EQ(rods(packed + packed).size(), 2u);                   // two gzip files in a row are one
  EXPECT_EQ(rods(packed + std::string(1000, '\0')).size(), 2u);  // a block filled up with zeros
  std::string damaged = packed + packed;
  damaged[packed.size()] = 'x';  // the second one is none any more
  expect_error(damaged, ":", "other bytes follow the compressed data");
  EXPECT_EQ(DumpReader(write("plain.gz", text)).next(*std::make_unique<DumpFrame>()), true);
  // Cut anywhere behind the two bytes that make it gzip, it gives an error.
  for (std::size_t length = 2; length < packed.size(); length++)
    EXPECT_NE(error(packed.substr(0, length)), "no error") << length;
  expect_error(packed.substr(0, packed.size() - 12), ":", "cannot be read any further: unexpected");
  std::string spoilt = packed;
  spoilt[packed.size() - 6] ^= 1;  // in the check sum
  expect_error(spoilt, ":", "cannot be read any further: incorrect data check");
}

// More than a block of lines of different lengths, read by all cores: every number arrives at its
// place, and an error far down has its own line.
TEST_F(DumpReaderTest, ManyBlocks)
{
  constexpr int kCount = 200000;
  std::string text = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n200000\nITEM: BOX BOUNDS ff ff ff\n"
                     "0 1\n0 1\n0 1\nITEM: ATOMS x id half element\n";
  for (int i = 1; i <= kCount; i++) text += fmt::format("{} {} {} Al\n", 0.5 * i, i, i / 2);
  ASSERT_GT(text.size(), std::size_t{1} << 22);
  const DumpFrame frame = frame_of(text);
  ASSERT_EQ(frame.rows, 200000u);
  ASSERT_EQ(frame.values.size(), 600000u);
  for (int i = 1; i <= kCount; i++) {
    ASSERT_EQ(frame.value(i - 1, 0), 0.5 * i);
    ASSERT_EQ(frame.value(i - 1, 1), i);
    ASSERT_EQ(frame.value(i - 1, 2), i / 2);
  }
  const auto spoil = [&](const std::string &row, const std::string &bad) {
    std::string spoilt = text;
    return spoilt.replace(spoilt.find("\n" + row + "\n") + 1, row.size(), bad);
  };
  for (int i = 20000; i < kCount; i += 20000) {
    const std::string row = fmt::format("{} {} {} Al", i / 2, i, i / 2);
    expect_error(spoil(row, fmt::format("{} {} nan Al", i / 2, i)), fmt::format(":{}: ", i + 9),
                 fmt::format("atom line {}: column 'half' is 'nan'", i));
  }
  expect_error(spoil("95000 190000 95000 Al", "95000 7 95000 Al"),
               ":190009: ", "id 7 was already on line 16");
  expect_error(spoil("95000 190000 95000 Al", "ITEM: TIMESTEP"),
               ":190009: ", "step 0 has 189999 atom lines, wanted 200000");
}

TEST_F(DumpReaderTest, BoundaryFlags)
{
  const auto with = [&](const std::string &flags) {
    std::string text = kHeader + kColumns + kRow1 + kRow2;
    return text.replace(text.find(" ff ff ff"), 9, flags);
  };
  using Flags = std::array<bool, 3>;
  EXPECT_EQ(frame_of(with(" ff ff ff")).periodic, (Flags{false, false, false}));
  EXPECT_EQ(frame_of(with(" pp fs pp")).periodic, (Flags{true, false, true}));
  EXPECT_EQ(frame_of(with(" pp sm pp ")).periodic, (Flags{true, false, true}));
  EXPECT_EQ(frame_of(with("")).periodic, (Flags{false, false, false}));
  expect_error(with(" pf ff ff"), ":5: ", "the boundary flag of the box is 'pf'");
  expect_error(with(" pp ff"), ":5: ", "the boundary flag of the box is ''");
  expect_error(with(" pp ff xx"), ":5: ", "the boundary flag of the box is 'xx'");
  expect_error(with(" pp ff ff ff"), ":5: ", "'ff' after three boundary flags");
}

TEST_F(DumpReaderTest, ScaledCoordinates)
{
  const auto found =
      rods(kHeader + "ITEM: ATOMS id xs ys zs shapex shapez quat1 quat2 quat3 quat4\n"
                     "1 0.5 0.25 0.1 0.01 0.1 1 0 0 0\n2 0 0 0 0.01 0.1 1 0 0 0\n");
  EXPECT_DOUBLE_EQ(found[0].capsule.segment.centre.x, 0.0);  // box -1 to 1
  EXPECT_DOUBLE_EQ(found[0].capsule.segment.centre.y, -0.5);
  EXPECT_DOUBLE_EQ(found[0].capsule.segment.centre.z, 1.0);  // box 0 to 10
}

TEST_F(DumpReaderTest, UnwrappedCoordinates)
{
  const auto found =
      rods(kHeader + "ITEM: ATOMS id xu ysu zu shapex shapez quat1 quat2 quat3 quat4\n"
                     "1 1.5 -0.25 11 0.01 0.1 1 0 0 0\n2 0 0 0 0.01 0.1 1 0 0 0\n");
  EXPECT_EQ(found[0].capsule.segment.centre.x, 1.5);
  EXPECT_DOUBLE_EQ(found[0].capsule.segment.centre.y, -1.5);  // -1 - 0.25 times 2
  EXPECT_EQ(found[0].capsule.segment.centre.z, 11.0);
}

TEST_F(DumpReaderTest, TiltedBox)
{
  const std::string head =
      "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz pp pp ff\n"
      "-1 1 0.2\n-1 1 0\n0 10 0\n";
  const DumpFrame frame = frame_of(head + kColumns + kRow1);
  EXPECT_TRUE(frame.box_is_tilted);
  EXPECT_EQ(frame.periodic, (std::array<bool, 3>{true, true, false}));
  expect_error(head + "ITEM: ATOMS id xs ys zs shapex shapez quat1 quat2 quat3 quat4\n"
                      "1 0.5 0.25 0.1 0.01 0.1 1 0 0 0\n",
               ":9: ", "column 'xs' scaled by a tilted box, wanted 'x'");
}

TEST_F(DumpReaderTest, SixDigitsAreEnough)
{
  // A norm off by 5e-4 is renormalised; shapez a digit below shapex is a sphere.
  const auto found =
      rods(kHeader + kColumns + "1 1 0 0 0 0.01 0.01 0.00999999 0.7075 0.7075 0 0\n" +
           "2 1 0 0 0 0.01 0.01 0.01 1 0 0 0\n");
  EXPECT_NEAR(norm(found[0].capsule.segment.axis), 1.0, 1e-15);
  EXPECT_TRUE(found[0].is_sphere());
  EXPECT_TRUE(found[1].is_sphere());
}

TEST_F(DumpReaderTest, WhatIsWrittenIsReadBack)
{
  BedOptions options;
  options.rods = 50;
  const auto bed = random_bed(options);
  const auto found = rods(dump_text(bed, 3));
  ASSERT_EQ(found.size(), bed.size());
  for (std::size_t i = 0; i < bed.size(); i++) {
    // Six digits of numbers up to 1.
    EXPECT_NEAR(std::abs(dot(found[i].capsule.segment.axis, bed[i].capsule.segment.axis)), 1.0,
                1e-5);
    EXPECT_NEAR(found[i].capsule.segment.half_length, bed[i].capsule.segment.half_length, 1e-6);
    EXPECT_NEAR(volume(found[i].capsule), volume(bed[i].capsule), 1e-4 * volume(bed[i].capsule));
  }
}

TEST_F(DumpReaderTest, FrameChoice)
{
  const auto bed = even_directions(3);
  std::vector<Rod> rods;
  std::string text = dump_text(rods, 0);
  for (const Vec3 &u : bed) {
    const auto id = static_cast<std::int64_t>(rods.size()) + 1;
    rods.push_back({id, 1, {{{0, 0, 1}, u, 0.1}, 0.01}});
    text += dump_text(rods, 100 * id);
  }
  const std::string path = write("many.dump", text);
  const auto steps = [&](const std::string &word) {
    std::vector<std::int64_t> found;
    for_each_frame(path, parse_frame_choice(word),
                   [&](const DumpFrame &frame) { found.push_back(frame.step); });
    return found;
  };
  EXPECT_EQ(steps("all"), (std::vector<std::int64_t>{0, 100, 200, 300}));
  EXPECT_EQ(steps("first"), std::vector<std::int64_t>{0});
  EXPECT_EQ(steps("last"), std::vector<std::int64_t>{300});
  EXPECT_EQ(steps("200"), std::vector<std::int64_t>{200});
  EXPECT_THROW(steps("150"), InputError);
  EXPECT_THROW(parse_frame_choice("lest"), InputError);
  EXPECT_THROW(parse_frame_choice("-1"), InputError);
}

TEST_F(DumpReaderTest, NotADump)
{
  expect_error("", ": is empty", "ITEM: TIMESTEP");
  expect_error("\n\n", ":", "holds no text");
  expect_error("id,x,y\n", ":1: ", "not a LIGGGHTS dump file");
  expect_error(std::string("\x7f"
                           "ELF\0\1\2\n\xff\xfe",
                           10),
               ":1: ", "");
  expect_error(std::string(5000000, 'x') + "\n", ":1: ", "the line is longer than 4194304 bytes");
  EXPECT_THROW(DumpReader(path("missing.dump")), InputError);
  EXPECT_THROW(DumpReader(path(".")), InputError);
}

TEST_F(DumpReaderTest, CutOff)
{
  const std::string whole = kHeader + kColumns + kRow1 + kRow2;
  expect_error(kHeader + kColumns + kRow1,
               ":10: ", "the file ends after 1 atoms of step 7, wanted 2");
  expect_error(kHeader + kColumns, ":9: ", "the file ends after 0 atoms of step 7, wanted 2");
  expect_error(kHeader, ":8: ", "the file ends here, wanted an 'ITEM:' line");
  expect_error("ITEM: TIMESTEP\n", ":1: ", "wanted the time step");
  // Cut anywhere, the file gives an error and no frame.
  for (std::size_t length = 0; length < whole.size(); length++)
    EXPECT_NE(error(whole.substr(0, length)), "no error") << length;
  // A second frame that is cut does not pass for the end either.
  for (std::size_t length = 1; length < whole.size(); length += 7)
    EXPECT_NE(error(whole + whole.substr(0, length)), "no error") << length;
}

TEST_F(DumpReaderTest, WrongCounts)
{
  expect_error(kHeader + kColumns + kRow1 + kHeader + kColumns + kRow1 + kRow2,
               ":11: ", "step 7 has 1 atom lines, wanted 2");
  expect_error(kHeader + kColumns + kRow1 + kRow2 + "3" + kRow1.substr(1),
               ":12: ", "wanted 'ITEM: TIMESTEP' or the end of the file");
  expect_error(kHeader + kColumns + "1 2 3\n" + kRow2, ":10: ", "too few words, wanted 12");
  expect_error(kHeader + kColumns + kRow1.substr(0, kRow1.size() - 1) + "9\n" + kRow2,
               ":10: ", "too many words, wanted 12");
  expect_error("ITEM: TIMESTEP\nten\n", ":2: ", "the time step is 'ten'");
  expect_error("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n-3\n",
               ":4: ", "the number of atoms is '-3', wanted a whole number >= 0");
  expect_error("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n9999999999999999999999\n", ":4: ", "");
  expect_error("ITEM: TIMESTEP\n0\n" + kColumns, ":3: ", "came before 'ITEM: NUMBER OF ATOMS'");
  expect_error("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\n" + kColumns,
               ":5: ", "came before 'ITEM: BOX BOUNDS'");
  // A promise of more atoms than any memory holds is not believed.
  expect_error("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n4000000000000000000\nITEM: BOX BOUNDS ff "
               "ff ff\n0 1\n0 1\n0 1\n" +
                   kColumns + kRow1,
               ":10: ", "ends after 1 atoms");
}

TEST_F(DumpReaderTest, BadBox)
{
  const std::string head =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n0\nITEM: BOX BOUNDS ff ff ff\n";
  expect_error(head + "0 one\n", ":6: ", "wanted two finite numbers");
  expect_error(head + "0 inf\n", ":6: ", "wanted two finite numbers");
  expect_error(head + "1 0\n", ":6: ", "the upper bound of the box is 0, wanted >= 1");
  expect_error(head + "0 1 2\n", ":6: ", "the bounds of the box are '0 1 2', wanted 2 numbers");
  expect_error(head + "0 1\nITEM: ATOMS id\n", ":7: ", "wanted two finite numbers");
}

TEST_F(DumpReaderTest, MissingColumnsAreNamed)
{
  for (const std::string name : {"id", "x", "z", "shapex", "shapez", "quat1", "quat4"}) {
    std::string names = kColumns;
    names.replace(names.find(" " + name + " "), name.size() + 2, " other ");
    expect_error(kHeader + names + kRow1 + kRow2, ":9: ", "column '" + name + "' is missing");
  }
  std::string twice = kColumns;
  twice.replace(twice.find("type"), 4, "x");
  expect_error(kHeader + twice + kRow1 + kRow2, ":9: ", "column 'x' appears twice");
}

TEST_F(DumpReaderTest, BadNumbers)
{
  const auto with = [&](const std::string &row) { return kHeader + kColumns + kRow1 + row; };
  expect_error(with("2 1 nan 0 0 0.01 0.01 0.1 1 0 0 0\n"),
               ":11: ", "column 'x' is 'nan', wanted a finite number");
  expect_error(with("2 1 0 -inf 0 0.01 0.01 0.1 1 0 0 0\n"), ":11: ", "column 'y' is '-inf'");
  expect_error(with("2 1 0 0 1e999 0.01 0.01 0.1 1 0 0 0\n"), ":11: ", "column 'z' is '1e999'");
  expect_error(with("2 1 0 0 0x1f 0.01 0.01 0.1 1 0 0 0\n"), ":11: ", "column 'z' is '0x1f'");
  expect_error(with("1 1 0 0 0 0.01 0.01 0.1 1 0 0 0\n"), ":11: ", "id 1 was already on line 10");
  expect_error(with("2.5 1 0 0 0 0.01 0.01 0.1 1 0 0 0\n"), ":11: ", "id is 2.5");
  expect_error(with("0 1 0 0 0 0.01 0.01 0.1 1 0 0 0\n"), ":11: ", "id is 0, wanted");
  expect_error(with("-2 1 0 0 0 0.01 0.01 0.1 1 0 0 0\n"), ":11: ", "id is -2, wanted");
  expect_error(with("9007199254740993 1 0 0 0 0.01 0.01 0.1 1 0 0 0\n"),  // 2^53 + 1
               ":11: ", "wanted a whole number from 1 up, below 2^53");
  expect_error(with("2 0 0 0 0 0.01 0.01 0.1 1 0 0 0\n"), ":11: ", "type is 0");
  expect_error(with("2 1 0 0 0 0.01 0.01 0.1 0 0 0 0\n"),
               ":11: ", "rod 2: the norm of quat1..4 is 0, wanted 1");
  expect_error(with("2 1 0 0 0 0.01 0.01 0.1 0.9 0 0 0\n"), ":11: ", "quat1..4 is 0.9, wanted 1");
  expect_error(with("2 1 0 0 0 0.01 0.01 0.1 1e200 1e200 0 0\n"), ":11: ", "quat1..4 is inf");
  expect_error(with("2 1 0 0 0 0 0 0.1 1 0 0 0\n"), ":11: ", "shapex is 0, wanted a radius > 0");
  expect_error(with("2 1 0 0 0 -1 -1 0.1 1 0 0 0\n"), ":11: ", "shapex is -1");
  expect_error(with("2 1 0 0 0 0.01 0.01 0.009 1 0 0 0\n"),
               ":11: ", "shapez is 0.009, wanted at least shapex, 0.01");
  expect_error(with("2 1 0 0 0 0.01 0.02 0.1 1 0 0 0\n"), ":11: ", "shapey is 0.02, wanted 0.01");
}

// %g prints numbers below 1e-308 too, as an angular velocity that fades away.
TEST_F(DumpReaderTest, TinyNumbers)
{
  const auto found =
      rods(kHeader + kColumns + kRow1 + "2 1 1e-310 -4.94066e-324 0 1e-2 .01 0.1 1 0 0 0\n");
  EXPECT_EQ(found[1].capsule.segment.centre.x, 1e-310);
  EXPECT_LT(found[1].capsule.segment.centre.y, 0.0);
}

// Files that the fuzzer starts from, and those that once broke a promise: read_dump_bytes ends the
// program if it is broken again.
TEST_F(DumpReaderTest, FuzzCorpus)
{
  std::size_t files = 0, good = 0;
  for (const auto &entry : std::filesystem::directory_iterator(CORPUS_FOLDER)) {
    if (entry.path().filename() == ".gitattributes") continue;
    files++;
    good += read_dump_bytes(entry.path().string()).empty();
    read_bytes(entry.path().string());
  }
  const std::string corpus = CORPUS_FOLDER;
  EXPECT_EQ(read_local_bytes(corpus + "/local", LocalKind::Pairs), "");
  EXPECT_GE(files, 15u);
  EXPECT_GE(good, 6u);  // plain, two_steps, crlf, gzip, tilted, scaled, no_atoms
  EXPECT_GE(files - good, 7u);
}

TEST_F(DumpReaderTest, Quantities)
{
  const auto bed = random_bed({});
  const DumpFrame frame = frame_of(dump_text(bed, 0));
  const auto found = rods_of(frame);
  const RodQuantity elevation = rod_quantity(frame, found, "elevation");
  EXPECT_EQ(elevation.high, 90.0);
  // The test bed's velocities are (w, 0, -w), w = 0.01 (id mod 7).
  const RodQuantity speed = rod_quantity(frame, found, "speed");
  EXPECT_NEAR(speed.high, 0.06 * std::sqrt(2.0), 1e-6);
  RodQuantity id = rod_quantity(frame, found, "id");
  EXPECT_EQ(id.values[4], 5.0);
  // Of 1 to 20 in any order the two lowest and the two highest are left out.
  id.values.clear();
  for (int i = 0; i < 20; i++) id.values.push_back(1 + (7 * i) % 20);
  set_range_of_most(id);
  EXPECT_EQ(id.low, 3.0);
  EXPECT_EQ(id.high, 18.0);
  id.values = {4.0};
  set_range_of_most(id);
  EXPECT_EQ(id.low, 4.0);
  EXPECT_EQ(id.high, 4.0);
  EXPECT_THROW(rod_quantity(frame, found, "colour"), InputError);
}

}  // namespace
}  // namespace spherocylinder
