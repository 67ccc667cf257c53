#pragma once

/// @file
/// Every number of the separation curve that was chosen, not derived: what it means, on which frames it was set,
/// and what it costs to leave it out. Numbers of equations are those of doc/separation_curve.md.
///
/// *Costs* are percent of frames whose pull-off force lies within 1.15 and within 1.3 of the half-space's, on the
/// error map (289 frames) and on 378 others drawn alike with other seeds: "map -0.7, -1.1; others -0.3, 0". The sets of frames: *map* is that of
/// doc/trust.md, *second* and *third* are drawn like it; *spheres* are single ones against the 9-3 half-space and
/// Maugis; *bonded* are frames of flattening ratios below 1, *brittle* ones of them have cohesive lengths below a
/// tenth of the correlation length.

#include <cmath>

#include "mems_stiction/contact/model_statement.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {
namespace chosen {

// ---------------------------------------------------------------- contacts

/// Maugis' parameter over Tabor's, for the 9-3 law, (S8): with Maugis' own 1.157 the pull-off force of a sphere
/// lies up to 5 % below that of the law, with 0.56 it is that of the law; in between within 3 % of it and 5 % of
/// his. Set on spheres. 1.157 in its place: map -1.1, 0; others -1.3, -0.5
constexpr double kMaugisPerTabor = 0.75;

/// What a bent summit loses where its neighbours hold on, of what it loses alone, (S7) [-]. Set on frames beside
/// the map's. Without company (1): map -1.1, -0.4; others -2.4, -0.5
constexpr double kLossInCompany = 0.6;

/// Added to the depth that tells the radius of a summit in reach, of z0: a patch that has just come into reach has
/// hardly any. Set with (S7). Without (0): map -0.7, 0; others -0.8, -0.3
constexpr double kLeastDepth = 0.05;

/// Largest exponent m with which a patch is taken to grow with its depth, (S8b): that of a cone. Without (S8b), m =
/// 1: map -0.7, -0.7; others 0, 0. It is the tips of doc/separation_curve.md that need it.
constexpr double kMostGrowth = 2.0;

/// Tabor's parameter up to which a summit lets go where it would touch, (S8a): the law's own range does as much.
/// Set on the map and the second set. Without, nothing holds on: map -1.8, -0.7; others -2.9, -1.1
constexpr double kStiffTabor = 0.5;
/// b over (mu - 1/2) z0, (S8a): JKR's displacement at the pull-off, (1/3) (9 pi/8)^(2/3) = 0.77. Derived.
inline const double kHoldPerTabor = std::cbrt(9.0 * kPi / 8.0 * (9.0 * kPi / 8.0)) / 3.0;
/// Longest b, of z0. No frame of the map asks for it; without it rubber (mu above 6), whose whole surface is in
/// reach, would give more work than Gamma.
constexpr double kLongestHold = 4.0;

/// A contact of which flow has taken less than the one share of what it would carry counts as elastic, one that
/// carries more than the other of what it can as plastic. Regimes alone hang on them: no force.
constexpr double kElasticShare = 0.97;
constexpr double kPlasticShare = 0.95;

// ---------------------------------------------------------------- surfaces that conform

/// Flattening ratio below which surfaces conform. Set on the map, the other 378 and 120 brittle frames: there both
/// candidates err alike. Never (0): map -12.8, -10.4; others -10.9, -5.8. Always below what energy allows (1): map
/// -0.4, 0; others -0.3, -0.5, and one of the brittle frames is 9 times too strong.
constexpr double kConformingRatio = 0.75;

/// Radius of the weakest place, in cohesive lengths, (S10b). Set on spheres in arrays and bonded frames. The whole
/// frame in its place: map -1.1, -0.4; others -0.5, -0.3
constexpr double kPlaceRadius = 3.0;
/// Power of l q with which a wave becomes a short one, (S10a). Set on bonded frames. 2 in its place: map -0.7, 0;
/// others +0.3, +0.2
constexpr double kLongWavePower = 4.0;

/// Shortest cracks, in cohesive lengths, and longest ones, over the mean wave number, (S10c): shorter ones the law
/// opens, not their edge; in longer ones there is no more tension. Without: map -0.7, 0; others -0.5, -0.8; map -0.4,
/// 0; others -0.3, 0, and time
constexpr double kShortestCrack = 2.0;
constexpr double kLongestCrack = 4.0;
/// Griffith's balance, (S10d): factor, decay with the flattening ratio, and what a long cohesive length takes. Set
/// on brittle frames. 1 in their place: map -1.1, -0.4; others -0.3, -0.5; map -1.4, -1.8; others -0.8, -0.8;
/// without the last: map -1.4, -0.7; others -0.5, -0.8
constexpr double kGriffith = 0.85;
constexpr double kDecay = 2.0;
constexpr double kCohesion = 0.56;

/// Opposite edges fit each other, so that the frame repeats itself, if they differ by no more than this times what
/// neighbours do. The map's frames repeat themselves, but for parts of scans. All mirrored (0): map -0.7, -0.7;
/// others -0.8, -0.5
constexpr double kFittingEdges = 3.0;

// ---------------------------------------------------------------- what the curve says of its own error

/// Flattening ratio below which stiff contacts (DMT) may grow together, and soft ones (JKR) at twice that [-]. Set on the
/// map, whose rows for near bonding (doc/trust.md) say what it parts. No force hangs on it or on the next two: the flag and
/// the interval do.
constexpr double kNearBonding = 2.0;
/// Up to this ratio, contacts that join one after another may pull each other together.
constexpr double kJoiningOnes = 6.0;
/// Rise of the force, of the largest one, that tells of such contacts [-].
constexpr double kJoiningRise = 0.1;

/// Standard deviations of the logarithm of force and work, by the map's rows (doc/trust.md). That of conforming surfaces is
/// made by one brittle frame at the criterion for open valleys, which is out by 2.6; without it, it is 0.07.
constexpr ModelError kConformingError{0.14, 0.05};
constexpr ModelError kNearBondingError{0.12, 0.11};
constexpr ModelError kSparseError{0.05, 0.04};

// ---------------------------------------------------------------- steps and limits: they cost accuracy or time, not physics

/// Approaches before first touch where the curve begins, of z0: up to there what is left of the work is w.
constexpr double kApart[] = {-12.0, -8.0, -6.0, -4.5, -3.5, -2.8, -2.2, -1.8, -1.5, -1.2, -1.0};
/// Steps, of z0 and of the approach, whichever is more: the maximum is that of a parabola, within 0.5 %.
constexpr double kStep = 0.1;
constexpr double kStepPerApproach = 0.05;
/// Surfaces that carry this many times what can pull them together push each other apart from there on, and get so
/// many steps to rest. No frame of the map changes without it: it saves time where loads press surfaces together.
constexpr double kPushing = 2.0;
constexpr int kPushingSteps = 8;
/// Most places that are tried for the rest, and what the forces there may lack of what is carried.
constexpr int kRestSearches = 24;
constexpr double kRestAccuracy = 1e-3;
/// Shortest secant that tells the stiffness at rest, of z0: forces are known to a thousandth of what is carried.
constexpr double kStiffnessLength = 0.05;
/// Least depth of a patch that opens the gap around it, of z0: no division by 0.
constexpr double kLeastOpening = 1e-6;

/// Lines of each direction that tell the flattening energy, growth of their distances, longest one as a part of the
/// line: another choice moves U by a few percent.
constexpr int kLines = 48;
constexpr double kLagGrowth = 1.25;
constexpr int kLagsPerLine = 4;
/// Blocks of a relief along each side at most: what is cut away is far shorter than a frame.
constexpr int kMostBlocks = 512;
/// From one crack to the next: what opens a valley most is missed by 2 % between two.
constexpr double kNextCrack = 1.5;
/// Springs: closest and farthest gap of the table of the law, of z0, and its points; classes of depth; heights of
/// the branch, and the least end of it, of z0. Another choice moves forces by 1e-3 at most.
constexpr double kClosest = 0.45;
constexpr double kFarthest = 400.0;
constexpr int kLawPoints = 4000;
constexpr int kClasses = 1024;
constexpr int kHeights = 240;
constexpr double kFarEnough = 2.5;

}  // namespace chosen
}  // namespace mems_stiction
