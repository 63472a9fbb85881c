// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where an object's own points lie, finer than the voxels of the map, and the area they cover.
///
/// Ours. A hull of all shapes grows with every error ([hypermap] 5.2.3 measures that); here each
/// observation votes for cells, and cells that few observations agree on do not count.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/polygon.hpp"

#include <Eigen/Core>

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

class CellBlocks;
struct OptionTable;

/// A cell of the point grid: floor(p / edge) on each axis. Source: [smap] Eq. (3.8), restored.
struct PointCell {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;
  friend auto operator<=>(const PointCell&, const PointCell&) = default;
};

/// A cell and how many observations had a point in it.
struct PointVote {
  PointCell cell;
  std::uint32_t votes = 0;
  friend auto operator<=>(const PointVote&, const PointVote&) = default;
};

struct OccupancyVotesOptions {
  double edge_m = 0.01;             ///< Edge of a cell to begin with.
  std::uint32_t max_cells = 16384;  ///< More make cells twice as wide.
  /// A cell counts when it has at least this share of the votes that a typical vote's cell has, or
  /// the best cell of its block where that has less: what was seen seldom is no error for that. 0
  /// counts all: the hull of all errors.
  double min_vote_share = 0.25;
  /// A cell counts when, besides, the block of 4 x 4 x 4 cells that it lies in has at least this
  /// share of the votes that a typical vote's block has, each for as many cells as a block usually
  /// has. Points of a large surface rarely fall into one cell twice, so that its cells alone cannot
  /// tell a single segment's error. Where a cell of
  /// the block has three votes, and min_vote_share of the observations that had the block in view,
  /// as much is asked as from so many observations. 0 counts all.
  double min_block_share = 0.1;
  friend bool operator==(const OccupancyVotesOptions&, const OccupancyVotesOptions&) = default;
};

/// Errors: kInvalidArgument naming the field and its range.
[[nodiscard]] Result<void> validate(const OccupancyVotesOptions& options);
[[nodiscard]] const OptionTable& option_table(const OccupancyVotesOptions& options);

/// Everything that a OccupancyVotes remembers, for storing it.
struct OccupancyVotesState {
  double edge_m = 0.01;                ///< Now: the first edge, doubled some times.
  std::uint32_t num_observations = 0;  ///< That voted.
  std::vector<PointVote> votes;        ///< Ascending by cell.
  /// Of blocks of 4 x 4 x 4 cells, by their place in the grid of blocks, how many observations had
  /// them in view, 1 and more; ascending. All others were in view of each observation, or nobody
  /// looked.
  std::vector<PointVote> looks;
  friend bool operator==(const OccupancyVotesState&, const OccupancyVotesState&) = default;
};

/// Whether an observation had the point in view.
using IsInView = std::function<bool(const Eigen::Vector3d& point_in_map)>;

/// Where two objects contest a cell: in it alone, or in the other's block of 4 x 4 x 4 around it.
enum class ContestedPlace : std::uint8_t { kCell, kBlock };

/// What the observations of an object say of a cell that one of them voted for.
enum class CellStanding : std::uint8_t {
  kStray,      ///< Few have points near it.
  kSupported,  ///< Enough have points in its block, too few in the cell itself.
  kAgreed,     ///< It counts.
};

/// Which cells of a state count, and where they lie. Follows from the state and the options.
struct CellAgreement {
  std::uint32_t typical_votes = 1;  ///< Of the cell of a typical vote.
  std::uint32_t votes_needed = 1;   ///< Of a cell that counts, in a block of typical cells.
  std::size_t num_cells = 0;        ///< That count.
  PointCell low;                    ///< The lowest coordinates of those; zeros when there are none.
  PointCell high;                   ///< The highest ones.
  friend bool operator==(const CellAgreement&, const CellAgreement&) = default;
};

/// A bounded set of voted cells. Frame: Map. A value; memory at most max_cells cells, shared by
/// copies until one of them observes.
class OccupancyVotes {
 public:
  OccupancyVotes() : OccupancyVotes(OccupancyVotesOptions{}) {}
  /// Requires: validate(options).
  explicit OccupancyVotes(const OccupancyVotesOptions& options);
  /// Errors: as validate(options); kInvalidArgument when the cells are not ascending, are more than
  /// allowed, have no votes or more votes than observations, or the edge is not the options' edge
  /// doubled.
  [[nodiscard]] static Result<OccupancyVotes> from_state(const OccupancyVotesOptions& options,
                                                         OccupancyVotesState state);

  /// One observation votes once for each cell that it has a point in. It counts as if it had all
  /// blocks in view, until `look` says otherwise.
  /// Boundary: points that are not finite or beyond 1e6 m are left out.
  /// Cost: O((points + cells) log).
  void observe(std::span<const Eigen::Vector3f> points_in_map);
  /// Counts which blocks the newest observation had in view: those that it has a point in, and
  /// those whose centre `is_in_view` says so of. What was seen by few, since few looked there, is
  /// told from what few segments took in although others looked. A block that this observation is
  /// the first to have a point in counts as seen by `num_looks_from_there` earlier ones, too: as
  /// many as were made from about the same direction. Requires: `points_in_map` are those of the
  /// newest `observe`. Cost: O(points + cells); asks once for each block without a point.
  void look(std::span<const Eigen::Vector3f> points_in_map,
            const IsInView& is_in_view,
            std::uint32_t num_looks_from_there);
  /// Adds the votes of another evidence of the same object.
  void merge(const OccupancyVotes& other);

  /// Gives up the cells that another object's observations agree on more, by `factor` and more;
  /// votes count relative to the cell of a typical vote of either. Of finer cells of the other the
  /// best one counts, with kBlock the best one of its block. Returns how many went.
  /// Requires: factor > 0.
  /// Boundary: all stay when none would be left.
  /// Cost: O(cells of the slabs of x that both have); allocates for the cells that go.
  std::size_t yield_to(const OccupancyVotes& other,
                       double factor,
                       ContestedPlace place = ContestedPlace::kCell);

  /// Takes a vote from the cells at these positions of the state; a cell without votes goes.
  /// Requires: positions ascend, each once, below the number of cells.
  /// Boundary: nothing changes when no cell would be left. Cost: O(cells).
  void deny(std::span<const std::size_t> positions);

  /// How many cells enough observations agree on, and where those lie.
  [[nodiscard]] const CellAgreement& agreement() const noexcept { return agreement_; }
  /// Of each cell of the state, in its order.
  [[nodiscard]] std::span<const CellStanding> standings() const noexcept { return *standings_; }
  /// Centres of the cells that enough observations agree on, in the order of cells.
  [[nodiscard]] std::vector<Eigen::Vector3d> agreed_points() const;
  /// Those and the supported ones: all of a surface, with the noise across it.
  [[nodiscard]] std::vector<Eigen::Vector3d> supported_points() const;
  /// Box of the agreed points, a quarter of a cell wider. None when empty. Cost: O(1).
  [[nodiscard]] std::optional<Box> agreed_box() const;
  /// Convex hull, from above, of the agreed points, each a square of half a cell.
  /// Errors: kNotFound when there are no points.
  [[nodiscard]] Result<Polygon> footprint() const;

  [[nodiscard]] bool empty() const noexcept { return state_->votes.empty(); }
  [[nodiscard]] const OccupancyVotesState& state() const noexcept { return *state_; }
  [[nodiscard]] const OccupancyVotesOptions& options() const noexcept { return options_; }
  friend bool operator==(const OccupancyVotes& a, const OccupancyVotes& b) {
    return a.options_ == b.options_ && (a.state_ == b.state_ || *a.state_ == *b.state_);
  }

 private:
  /// Makes room first.
  void take(OccupancyVotesState state);
  /// Sets the state and what follows from it. Requires: there is room.
  void adopt(OccupancyVotesState state);
  /// The same, whose cells lie in these blocks.
  void adopt(OccupancyVotesState state, const CellBlocks& blocks);
  [[nodiscard]] std::vector<Eigen::Vector3d> points_from(CellStanding least) const;

  OccupancyVotesOptions options_;
  std::shared_ptr<const OccupancyVotesState> state_;  ///< Never null.
  /// Of state_: whoever sets one sets all three. Never null.
  std::shared_ptr<const std::vector<CellStanding>> standings_;
  CellAgreement agreement_;
};

}  // namespace hypermap
