// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/pair_skins.h"

#include <algorithm>
#include <cmath>

#include "core/skin.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

// Skins to begin with, in mean diameters.
constexpr double kFirstSkin = 0.3;
constexpr double kFirstListSkin = 1.0;
constexpr double kPairsToBeginWith = 8.0;  // of a rod's own half, in the list
// Where chosen: bounds, and when: after all rods have been found again so often, which takes some steps,
// or steps. In fewer, rods have hardly moved through the narrow skin.
constexpr double kThinnest = 0.05, kWidest = 1.0;
constexpr double kNarrowestBeyond = 0.5, kWidestBeyond = 4.0;
constexpr double kRenewalsToChoose = 3.0;
constexpr int64_t kFewestSteps = 200, kMostSteps = 2000;
constexpr double kLeastChange = 0.1;  // of a skin, that is worth it
// Of a rod's halves, for its speed; and what none is wider than, in mean diameters.
constexpr double kSlowest = 0.25, kFastest = 4.0;
constexpr double kWidestHalf = 1.0, kWidestHalfBeyond = 2.0;

// What the parts cost, in nanoseconds on the machine they were measured on; their ratios are what
// counts. A close pair is gathered and its closest points found, every step; a refresh of the close
// pairs walks along the rows of the rods that moved and finds the closest points of their pairs; a renewal
// of the list enters rods in cells and finds the closest points of those that share one.
constexpr double kTestCost = 15.0, kWalkCost = 1.5, kLookCost = 30.0;
constexpr double kCellCost = 45.0, kTryCost = 25.0;

}  // namespace

void PairSkins::reset(double close)
{
  work = Work();
  close_is_chosen_ = close == 0.0;
  if (!close_is_chosen_) close_ = close;
}

void PairSkins::begin(double diameter, double root_speed)
{
  diameter_ = diameter;
  root_speed_ = root_speed;
  if (listed_ == 0.0) {
    if (close_is_chosen_) close_ = kFirstSkin * diameter_;
    listed_ = kFirstListSkin * diameter_;
  }
  listed_ = std::max(listed_, close_ + kNarrowestBeyond * diameter_);
}

double PairSkins::factor(double speed) const
{
  if (!(root_speed_ > 0.0)) return 1.0;
  const double own = std::sqrt(speed) / root_speed_;
  return own > kSlowest ? std::min(own, kFastest) : kSlowest;  // a speed may not be a number
}

double PairSkins::close_half(double speed) const
{
  if (!close_is_chosen_) return close_half();
  return std::min(factor(speed) * 0.5 * close_, std::max(0.5 * close_, kWidestHalf * diameter_));
}

double PairSkins::beyond_half(double speed) const
{
  const double own = 0.5 * (listed_ - close_);
  return std::clamp(factor(speed) * own, std::min(own, 0.5 * kNarrowestBeyond * diameter_),
                    std::max(own, kWidestHalfBeyond * diameter_));
}

bool PairSkins::is_time_to_choose(int rods) const
{
  const bool enough =
      static_cast<double>(work.renewed) >= kRenewalsToChoose * rods && work.steps >= kFewestSteps;
  return enough || work.steps >= kMostSteps;
}

bool PairSkins::choose(double root_speed)
{
  are_tried_ = true;
  root_speed_ = root_speed;
  const double walk_cost = kWalkCost * static_cast<double>(work.walked);
  const double refresh_cost = walk_cost + kLookCost * static_cast<double>(work.looked_at);
  const double test_cost = kTestCost * static_cast<double>(work.tested);
  const double renewal_cost =
      kCellCost * static_cast<double>(work.cells) + kTryCost * static_cast<double>(work.tried);
  work = Work();

  double close = close_;
  if (close_is_chosen_)
    close = std::clamp(better_skin(close_, 0.0, diameter_, test_cost, refresh_cost),
                       kThinnest * diameter_, kWidest * diameter_);
  const double before = listed_;
  const double listed =
      std::clamp(better_skin(listed_, close_, diameter_, refresh_cost, renewal_cost),
                 close + kNarrowestBeyond * diameter_, close + kWidestBeyond * diameter_);
  if (std::fabs(close - close_) > kLeastChange * close_) close_ = close;
  if (std::fabs(listed - listed_) > kLeastChange * listed_) listed_ = listed;
  listed_ = std::max(listed_, close_ + kNarrowestBeyond * diameter_);
  return listed_ != before;
}

bool PairSkins::widen(int rods, int pairs)
{
  if (are_tried_) return false;
  const double skin =
      (diameter_ + listed_) * kPairsToBeginWith * rods / std::max(1, pairs) - diameter_;
  const double before = listed_;
  listed_ = std::max(listed_, std::min(skin, close_ + kWidestBeyond * diameter_));
  return listed_ > (1.0 + kLeastChange) * before;
}
