// SPDX-License-Identifier: GPL-2.0-or-later
// What stands in the figures, without drawing them: tables read back, means over beds, curves.
#include <cmath>

#include <gtest/gtest.h>

#include "analysis/csv_table.h"
#include "analysis/input_error.h"
#include "figures/bed_means.h"
#include "figures/paper_figures.h"
#include "scratch_folder.h"

namespace spherocylinder {
namespace {

class Figures : public ScratchFolder {
 protected:
  template <class Work>
  void expect_refusal(Work work, const std::string &words)
  {
    try {
      work();
      ADD_FAILURE() << "accepted; wanted a refusal with '" << words << "'";
    } catch (const InputError &error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }

  std::vector<PackingMean> packing(const std::string &text, const std::string &by = "")
  {
    return packing_means({write("packing.csv", text)}, "vf_inner", by);
  }

  std::vector<OrientationMean> orientation(const std::string &rows)
  {
    return orientation_means(
        {write("o.csv",
               "seed,elevation_low_deg,elevation_high_deg,density,density_error,"
               "isotropic_fraction,isotropic_scatter\n" +
                   rows)},
        "", "");
  }
};

TEST_F(Figures, TableReadsQuotesCommentsAndEmptyFields)
{
  const CsvTable table(
      write("t.csv", "# by hand\na,\"b, or c\",d\r\n\n1e3,\"x \"\"y\"\", z\",\r\n"));
  ASSERT_EQ(table.rows(), 1u);
  EXPECT_EQ(table.number(0, "a"), 1000.0);
  EXPECT_EQ(table.text(0, "b, or c"), "x \"y\", z");
  EXPECT_TRUE(table.is_empty(0, "d"));
  EXPECT_FALSE(table.has("e"));
  EXPECT_EQ(table.place(0), path("t.csv") + ":4");
}

TEST_F(Figures, TableRefusesWhatIsNoTable)
{
  const auto read_text = [&](const std::string &text) {
    return [this, text] { CsvTable table(write("t.csv", text)); };
  };
  expect_refusal(read_text(""), "t.csv: is empty");
  expect_refusal(read_text("a,b\n"), "holds no rows");
  expect_refusal(read_text("a,b\n1,2\n1\n"), "t.csv:3: 1 fields, wanted 2");
  expect_refusal(read_text("a,b\n1,2,3\n"), "t.csv:2: 3 fields, wanted 2");
  expect_refusal(read_text("a,a\n1,2\n"), "t.csv:1: column 'a' appears twice");
  expect_refusal(read_text("a,b\n1,\"2\n"), "t.csv:2: a double quote is not closed");
  expect_refusal([&] { CsvTable table(path("none.csv")); }, "none.csv: cannot be opened");
  expect_refusal([&] { CsvTable table(path(".")); }, "is a folder");
  const CsvTable table(write("t.csv", "a,b\n1,nan\n2,x\n"));
  expect_refusal([&] { table.number(0, "b"); }, "t.csv:2: b is 'nan', wanted a finite number");
  expect_refusal([&] { table.number(1, "b"); }, "t.csv:3: b is 'x'");
  expect_refusal([&] { table.text(0, "c"); }, "t.csv:1: column 'c' is missing; there are 'a b'");
}

// 1, 2, 3, 6: mean 3, squares about it 4 + 1 + 0 + 9 = 14, error sqrt(14/(4 3)).
TEST(BedMeans, MeanAndStandardError)
{
  const MeanWithError mean = mean_of(std::vector<double>{6, 1, 3, 2});
  EXPECT_NEAR(mean.mean, 3.0, 1e-15);
  EXPECT_NEAR(mean.error, std::sqrt(14.0 / 12.0), 1e-15);
  EXPECT_EQ(mean_of(std::vector<double>{7}).mean, 7.0);
  EXPECT_TRUE(std::isnan(mean_of(std::vector<double>{7}).error));
}

TEST_F(Figures, BedsOfOneKindAreAveraged)
{
  const auto means = packing(
      "limits,seed,lambda,vf_inner,mean_sin_gamma\n"
      "study,1,10,0.40,0.7\nnone,1,20,0.20,0.6\nstudy,2,10.00001,0.44,0.8\nstudy,1,5,0.5,\n",
      "limits");
  ASSERT_EQ(means.size(), 3u);
  EXPECT_EQ(means[0].group, "study");  // groups as they appear, lambda from small to large
  EXPECT_EQ(means[0].lambda, 5.0);
  EXPECT_TRUE(std::isnan(means[0].sin_gamma.mean));
  EXPECT_EQ(means[1].beds, 2u);
  EXPECT_NEAR(means[1].vf.mean, 0.42, 1e-15);
  EXPECT_NEAR(means[1].vf.error, 0.02, 1e-15);  // half the difference of two
  EXPECT_NEAR(means[1].sin_gamma.mean, 0.75, 1e-15);
  EXPECT_EQ(means[2].group, "none");
  EXPECT_TRUE(std::isnan(means[2].vf.error));  // of one bed
}

TEST_F(Figures, OneBedTwiceIsRefused)
{
  expect_refusal([&] { packing("lambda,vf_inner\n10,0.4\n10,0.4\n"); },
                 "packing.csv:3: a second row for one bed");
  expect_refusal([&] { packing("seed,lambda,vf_inner\n1,10,0.4\n2,10,0.4\n1,10,0.4\n"); },
                 "packing.csv:4: a second row for one bed");
  expect_refusal([&] { orientation("1,0,30,2,0.1,0.5,0.05\n1,0,30,2,0.1,0.5,0.05\n"); },
                 "o.csv:3: a second row for one bed");
}

TEST_F(Figures, WrongNumbersAreRefused)
{
  expect_refusal([&] { packing("lambda,vf_inner\n10,0.4\n20,-4e5\n"); },
                 "packing.csv:3: vf_inner is -400000, wanted from 0 to 1");
  expect_refusal([&] { packing("lambda,vf_inner\n10,1.01\n"); }, "vf_inner is 1.01, wanted from 0");
  expect_refusal([&] { packing("lambda,vf_inner,mean_sin_gamma\n10,0.4,1.2\n"); },
                 "mean_sin_gamma is 1.2, wanted from 0 to 1");
  for (const char *row : {"0.5,0.1,", "10,-0.1,", "10,0.1,-1"})
    expect_refusal(
        [&] {
          read_literature(write("l.csv", "lambda,vf,vf_error,kind,label,checked\n" +
                                             std::string(row) + ",a,b,yes\n"));
        },
        "l.csv:2: ");
  expect_refusal([&] { orientation("1,0,30,-2,0.1,0.5,0.05\n"); }, "density is -2, wanted >= 0");
  expect_refusal([&] { packing("lambda,vf_inner\n0.5,0.4\n"); }, "lambda is 0.5, wanted >= 1");
  expect_refusal([&] { packing("lambda,vf\n10,0.4\n"); }, "column 'vf_inner' is missing");
  expect_refusal(
      [&] { packing("lambda,vf_inner,vf_inner_error\n10,0.4,\n20,0.3,0.01\n"); },
      "packing.csv:3: vf_inner_error is 0.01, so that this is a mean over beds");
  expect_refusal([&] { orientation("1,30,10,2,0.1,0.5,0.05\n"); }, "a bin from 30 to 10 degrees");
  expect_refusal([&] { orientation("1,0,30,2,0.1,0,0.05\n"); }, "isotropic_fraction is 0");
  expect_refusal(
      [&] {
        orientation(
            "1,0,30,2,0.1,0.5,0.05\n1,30,90,0,0.1,0.5,0.05\n2,0,30,2,0.1,0.5,0.05\n");
      },
      "the bin from 30 to 90 degrees is in 1 of 2 beds");
  expect_refusal(
      [&] {
        read_literature(write("l.csv", "lambda,vf,vf_error,kind,label,checked\n1,1,,a,b,maybe\n"));
      },
      "l.csv:2: checked is 'maybe', wanted yes or no");
}

// One bed keeps the error of its counts; n beds scatter sqrt(n) less than one if isotropic.
TEST_F(Figures, OrientationOverBeds)
{
  const auto one = orientation("1,0,30,1.5,0.1,0.5,0.05\n1,30,90,0.5,0.1,0.5,0.05\n");
  ASSERT_EQ(one.size(), 1u);
  ASSERT_EQ(one[0].bins.size(), 2u);
  EXPECT_EQ(one[0].bins[0].density.mean, 1.5);
  EXPECT_EQ(one[0].bins[0].density.error, 0.1);
  EXPECT_NEAR(one[0].bins[0].isotropic_scatter, 0.1, 1e-15);
  EXPECT_NEAR(one[0].isotropic_rods, 100.0, 1e-9);  // sqrt(0.5 0.5/100) = 0.05
  const auto two = orientation("1,0,30,1.5,0.1,0.5,0.05\n2,0,30,1.7,0.1,0.5,0.05\n");
  EXPECT_EQ(two[0].beds, 2u);
  EXPECT_NEAR(two[0].bins[0].density.mean, 1.6, 1e-15);
  EXPECT_NEAR(two[0].bins[0].density.error, 0.1, 1e-15);
  EXPECT_NEAR(two[0].bins[0].isotropic_scatter, 0.1 / std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(two[0].isotropic_rods, 200.0, 1e-9);
}

double value_at(const Curve &curve, double x)
{
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const Point &a = curve.points[i - 1], &b = curve.points[i];
    if (x >= a.x && x <= b.x) return a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y);
  }
  return NAN;
}

// Values of 2 ln(lambda)/lambda and of the random contact equation worked out by hand for
// lambda = 20: V_p = 19/4 + 1/6, V_ex = 361 (2 s/pi) + 38 + 4/3, V_f = 10.5 V_p/V_ex: 0.2348 for
// s = pi/4 and 0.2781 for 2/pi. Chords of the drawn curve lie above it by less than 1e-3.
TEST(PaperFigures, CurvesOfTheory)
{
  std::vector<std::string> left_out;
  const Figure figure = packing_figure({{"", 30, 1, {0.1, 0}, {NAN, NAN}}}, {}, {}, left_out);
  const auto &curves = figure.panels.at(0).curves;
  ASSERT_EQ(curves.size(), 3u);
  EXPECT_NEAR(value_at(curves[0], 20), 0.2996, 1e-3);
  EXPECT_NEAR(value_at(curves[1], 20), 0.2781, 1e-3);
  EXPECT_NEAR(value_at(curves[2], 20), 0.2348, 1e-3);
  EXPECT_TRUE(std::isnan(value_at(curves[1], 4.9)));
}

TEST(PaperFigures, BedsAndTheirOwnRandomContacts)
{
  std::vector<std::string> left_out;
  const double isotropic = std::acos(-1.0) / 4.0;
  const Figure figure = packing_figure({{"a", 10, 5, {0.40, 0.01}, {isotropic, 0}},
                                        {"a", 20, 5, {0.21, 0.02}, {isotropic, 0}},
                                        {"b", 20, 1, {0.25, 0}, {NAN, NAN}}},
                                       {}, {{"a", "first"}}, left_out);
  const Panel &panel = figure.panels.at(0);
  ASSERT_EQ(panel.series.size(), 4u);  // of each group the expected, then the measured
  EXPECT_NEAR(panel.series[0].points.at(1).y, 0.2348, 5e-5);
  EXPECT_EQ(panel.series[1].points.at(1).x, 20);
  EXPECT_EQ(panel.series[1].points.at(1).y, 0.21);
  EXPECT_EQ(panel.series[1].points.at(1).error, 0.02);
  EXPECT_TRUE(panel.series[2].points.empty());
  ASSERT_EQ(panel.curves.size(), 4u);  // theory and the link between the two beds of a
  EXPECT_NEAR(value_at(panel.curves[3], 15), value_at(panel.curves[2], 15), 1e-3);
  ASSERT_EQ(panel.key.size(), 3u);
  EXPECT_EQ(panel.key[0].text, "first, 5 beds each");
  EXPECT_EQ(panel.key[1].text, "b, one bed");
}

// Relative luminance of sRGB as the Web Content Accessibility Guidelines (2.1) define it; they want
// a contrast of 4.5 of letters to their ground, here white.
double contrast_to_white(const Colour &colour)
{
  const auto linear = [](unsigned char part) {
    const double c = part / 255.0;
    return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const double luminance =
      0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) + 0.0722 * linear(colour.blue);
  return 1.05 / (luminance + 0.05);
}

TEST(PaperFigures, LettersAreDarkEnough)
{
  EXPECT_NEAR(contrast_to_white({255, 255, 255}), 1.0, 1e-12);
  EXPECT_NEAR(contrast_to_white({0, 0, 0}), 21.0, 1e-12);
  std::vector<std::string> left_out;
  const Figure packing = packing_figure({{"", 30, 1, {0.1, NAN}, {NAN, NAN}}}, {}, {}, left_out);
  const Figure orientation =
      orientation_figure({{"", "", 1, 25, {{0, 90, {1, 0}, 0.2}}}}, {}, false);
  ASSERT_EQ(packing.panels.at(0).labels.size(), 3u);
  ASSERT_EQ(orientation.panels.at(0).labels.size(), 1u);
  for (const Figure &figure : {packing, orientation})
    for (const Label &label : figure.panels.at(0).labels)
      EXPECT_GE(contrast_to_white(label.colour), 4.5) << label.text;
}

// Aligned rods touch at few places: the random contacts of theirs lie above all else, at 10.5 (19/4 +
// 1/6)/(38 + 4/3) = 1.31 for lambda = 20, which no bed can have and is not drawn; those of nearly aligned
// ones lie below.
TEST(PaperFigures, AxesHoldAllThatIsDrawn)
{
  std::vector<std::string> left_out;
  for (const double sin_gamma : {0.0, 0.1}) {
    const Figure figure =
        packing_figure({{"", 20, 1, {0.9, NAN}, {sin_gamma, NAN}}}, {}, {}, left_out);
    const Panel &panel = figure.panels.at(0);
    for (const Series &series : panel.series)
      for (const Measured &point : series.points) EXPECT_TRUE(panel.y.holds(point.y)) << point.y;
    EXPECT_EQ(panel.series.at(0).points.size(), sin_gamma > 0.0 ? 1u : 0u);
  }
  const Figure other = orientation_figure({{"", "", 1, 25, {{0, 90, {4, NAN}, 0.2}}}}, {}, false);
  EXPECT_TRUE(other.panels.at(0).y.holds(4.0));
}

// The band is that of the group with fewest rods, whose number stands beside it.
TEST(PaperFigures, BandSaysOfHowManyRodsItIs)
{
  const Figure figure = orientation_figure({{"", "10", 1, 500, {{0, 90, {1, 0.1}, 0.2}}},
                                            {"", "20", 1, 700, {{0, 90, {1, 0.1}, 0.1}}}},
                                           {}, true);
  EXPECT_EQ(figure.panels.at(0).labels.at(0).text, "±1 s.d. of 500 isotropic rods");
  EXPECT_NEAR(figure.panels.at(0).bands.at(0).high, 1.2, 1e-12);
}

TEST(PaperFigures, PublishedValues)
{
  std::vector<std::string> left_out;
  const Figure figure = packing_figure({{"", 30, 1, {0.1, 0}, {NAN, NAN}}},
                                       {{6.8, 0.58, 0.01, "experiment", "fibres", true},
                                        {12, 0.4, 0, "experiment", "recalled", false},
                                        {100, 0.04, 0, "simulation", "far", true}},
                                       {}, left_out);
  const Panel &panel = figure.panels.at(0);
  ASSERT_EQ(panel.series.size(), 4u);
  EXPECT_TRUE(panel.series[0].symbol.filled);
  EXPECT_EQ(panel.series[0].points.at(0).error, 0.01);
  EXPECT_FALSE(panel.series[1].symbol.filled);
  ASSERT_EQ(left_out.size(), 1u);
  EXPECT_EQ(left_out[0], "far at lambda = 100, V_f = 0.04 is beyond the axes");
  EXPECT_EQ(panel.key.at(2).text, "recalled (not checked)");
}

// Bins equal in solid angle are equally wide: sin 30 degrees = 1/2, so that the middles of the bins
// are at 1/4 and 3/4.
TEST(PaperFigures, ElevationIsOnAScaleOfSolidAngle)
{
  const OrientationMean mean{
      "", "10", 2, 25, {{0, 30, {1.5, 0.1}, 0.2}, {30, 90, {0.5, 0.1}, 0.2}}};
  const Figure figure = orientation_figure({mean}, {}, true);
  const Panel &panel = figure.panels.at(0);
  ASSERT_EQ(panel.series.size(), 1u);
  EXPECT_NEAR(panel.series[0].points.at(0).x, 0.25, 1e-12);
  EXPECT_NEAR(panel.series[0].points.at(1).x, 0.75, 1e-12);
  EXPECT_EQ(panel.series[0].points.at(0).y, 1.5);
  EXPECT_EQ(panel.key.at(0).text, "λ = 10, 2 beds");
  ASSERT_EQ(panel.bands.size(), 1u);
  EXPECT_NEAR(panel.bands[0].low, 0.8, 1e-12);
  EXPECT_NEAR(panel.bands[0].high, 1.2, 1e-12);
}

}  // namespace
}  // namespace spherocylinder
