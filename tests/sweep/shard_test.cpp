#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <list>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "plan/memory_need.hpp"
#include "support/temporary_directory.hpp"
#include "sweep/figures.hpp"
#include "sweep/joined.hpp"
#include "sweep/run.hpp"

namespace clatter::sweep::shard_test {
namespace {

using Bytes = std::vector<std::byte>;

/// How the points of a sweep start from each other.
struct Order {
  std::optional<std::size_t> follow{};
  Direction direction = Direction::up;
};

/// 30 points of every kind: periodic, aperiodic, with chatter and with no impact at all; each observable.
Sweep any_sweep(const Order& order = {}) {
  point::Problem scene = paper_scene(0.5, 1.0);
  scene.time.max_periods = 300;
  scene.observe = {};
  scene.observe.extrema = true;
  scene.observe.harmonics = 2;
  scene.observe.harmonics_samples = 600;  // rows, and parts of them
  scene.observe.impacts = true;
  scene.observe.impact_log = true;
  scene.observe.trajectory = 5;
  scene.observe.word = true;
  scene.observe.period = true;
  scene.observe.settling = true;
  scene.observe.attractor = true;
  scene.observe.stability = true;
  Sweep sweep = sweep_of(
      scene,
      {{Parameter("f"), {-1, 2}}, {Parameter("nu"), {0.5, 0.7, 0.9, 1.1, 1.3}}, {Parameter("R"), {0, 0.5, 0.9}}});
  sweep.follow = order.follow, sweep.direction = order.direction;
  return sweep;
}

results::Dataset shard_figure(const Sweep& sweep, const results::Shard& shard, const RunOptions& options = {}) {
  SweepRun run(sweep, shard);
  run.run(options);
  return dataset_of(run);
}

/// A shard's dataset as the part of a sweep.
Part part_of(const results::Dataset& dataset, const results::Shard& shard) {
  const auto find = [&dataset](const std::string& name) {
    return std::ranges::find(dataset.variables, name, &results::Variable::name);
  };
  const auto width_of = [&dataset](const results::Variable& variable) {
    std::size_t width = 1;
    for (const std::string& name : std::span(variable.dimensions).subspan(1))
      width *= std::ranges::find(dataset.dimensions, name, &results::NamedLength::name)->length;
    return width;
  };
  const auto rows = [=, &dataset](const std::string& name) -> std::optional<std::size_t> {
    const auto variable = find(name);
    if (variable == dataset.variables.end()) return std::nullopt;
    const std::size_t size = std::visit([](const auto& held) { return held.size(); }, variable->values);
    return (size + width_of(*variable) - 1) / width_of(*variable);
  };
  const auto values = [=](const std::string& name, std::size_t first, std::size_t count) {
    const results::Variable& variable = *find(name);
    return std::visit(
        [&](const auto& held) -> results::ValueArray {
          const std::size_t width = width_of(variable);
          const auto begin = held.begin() + static_cast<std::ptrdiff_t>(first * width);
          return std::vector(begin, begin + static_cast<std::ptrdiff_t>(count * width));
        },
        variable.values);
  };
  return {shard, rows, values};
}

/// The dataset of joined shards, with its values.
results::Dataset dataset_of(const Sweep& sweep, const std::vector<Part>& parts) {
  results::Dataset dataset = joined(sweep, parts, 2).dataset;
  collect(dataset);
  return dataset;
}

/// The pieces that a run hands over to be kept.
std::vector<Bytes> saved(SweepRun& run) {
  std::vector<Bytes> pieces;
  run.save([&](std::span<const std::byte> results) { pieces.emplace_back(results.begin(), results.end()); });
  return pieces;
}

const std::vector<Order> every_order{
    {}, {0}, {1}, {2}, {1, Direction::down}, {0, Direction::both}, {1, Direction::both}, {2, Direction::both}};

TEST(Shard, is_named_by_number_and_count) {
  EXPECT_EQ(results::shard_named("0/1"), (results::Shard{0, 1}));
  EXPECT_EQ(results::shard_named("3/8"), (results::Shard{3, 8}));
  EXPECT_EQ(results::text_of({3, 8}), "3/8");
  for (const char* wrong : {"", "/", "3", "3/", "/8", "8/8", "9/8", "-1/8", "+1/8", "1/0", "0/0", "1/8 ", " 1/8",
                            "1/8/2", "1.0/8", "0/1000001", "99999999999999999999/999999999999999999999"})
    EXPECT_EQ(results::shard_named(wrong), std::nullopt) << wrong;
}

TEST(Shard, has_each_point_once_in_ascending_order_and_whole_chains) {
  for (const Order& order : every_order) {
    const Sweep sweep = any_sweep(order);
    const Chains chains(sweep);
    for (std::size_t of = 1; of <= 33; ++of) {
      std::vector<int> owners(size(sweep), 0);
      for (std::size_t number = 0; number < of; ++number) {
        const Share share(sweep, results::Shard{number, of});
        std::vector<std::size_t> points(share.points(), size(sweep));
        for (std::size_t n = 0; n < share.count(); ++n)
          for (std::size_t i = 0; i < share.length(); ++i) {
            ASSERT_EQ(share.point(n, i), chains.point(number + n * of, i));
            ASSERT_LT(share.local_index(n, i), points.size());
            points[share.local_index(n, i)] = share.point(n, i);
            ++owners[share.point(n, i)];
          }
        EXPECT_TRUE(std::ranges::is_sorted(points, std::ranges::less_equal{})) << number << '/' << of;
        for (std::size_t point = 0, before = 0; point <= size(sweep); ++point) {
          ASSERT_EQ(share.points_before(point), before);
          if (before == points.size() || points[before] != point) continue;
          ASSERT_EQ(share.point_at(before++), point);
        }
      }
      EXPECT_TRUE(std::ranges::all_of(owners, [](int owner) { return owner == 1; })) << of;
    }
  }
}

TEST(Shard, figures_make_that_of_the_whole_sweep_bit_for_bit) {
  for (const Order& order : every_order) {
    const Sweep sweep = any_sweep(order);
    const results::Dataset whole = run(sweep, {.threads = 1}).dataset;
    for (const std::size_t of : {1U, 3U, 40U}) {
      std::list<results::Dataset> figures;
      std::vector<Part> parts;
      for (std::size_t number = of; number-- > 0;) {
        const results::Shard shard{number, of};
        figures.push_back(shard_figure(sweep, shard, {.threads = static_cast<int>(1 + number % 3)}));
        parts.push_back(part_of(figures.back(), shard));
      }
      expect_same(whole, dataset_of(sweep, parts));
    }
  }
}

TEST(Shard, results_in_files_are_those_in_memory) {
  const support::TemporaryDirectory directory;
  for (const Order& order : every_order) {
    const Sweep sweep = any_sweep(order);
    for (const std::optional<results::Shard> shard : {std::optional<results::Shard>(), {results::Shard{1, 3}}}) {
      SweepRun in_memory(sweep, shard),
          in_files(sweep, shard, std::make_shared<storage::Scratch>(directory.path("out.h5"), 0));
      in_memory.run({.threads = 1}), in_files.run({.threads = 2});
      EXPECT_EQ(saved(in_memory), saved(in_files));
      expect_same(dataset_of(in_memory), dataset_of(in_files));
    }
  }
}

TEST(Shard, figure_of_another_one_is_refused) {
  Sweep sweep = any_sweep();
  for (Dimension& dimension : sweep.dimensions) dimension[0].values.resize(2);
  const results::Dataset figure = shard_figure(sweep, {0, 2}), rest = shard_figure(sweep, {1, 2});
  const auto refusal = [&](const results::Dataset& first, const results::Shard& shard = {0, 2}) -> std::string {
    try {
      static_cast<void>(dataset_of(sweep, {part_of(first, shard), part_of(rest, {1, 2})}));
      return "";
    } catch (const PartError& error) {
      EXPECT_EQ(error.part(), 0U);
      return error.what();
    }
  };
  EXPECT_EQ(refusal(figure), "");
  EXPECT_NE(refusal(figure, {1, 2}).find("points"), std::string::npos);
  EXPECT_NE(refusal(figure, {0, 3}).find("points"), std::string::npos);
  EXPECT_NE(refusal(run(sweep, {}).dataset).find("'point'"), std::string::npos);
  results::Dataset shorter = figure;  // one impact less than its points have
  for (results::Variable& variable : shorter.variables)
    if (variable.dimensions == std::vector<std::string>{"impact"})
      std::visit([](auto& values) { values.pop_back(); }, variable.values);
  std::ranges::find(shorter.dimensions, "impact", &results::NamedLength::name)->length -= 1;
  EXPECT_NE(refusal(shorter).find("'impact_count'"), std::string::npos);
  for (const results::Variable& variable : figure.variables) {
    if (variable.dimensions == std::vector{variable.name} && variable.name != "point") continue;  // not read
    if (variable.name == "attractor" || variable.name.starts_with("motion_")) continue;           // made anew
    results::Dataset without = figure, longer = figure, other = figure;
    const auto at = &variable - figure.variables.data();
    without.variables.erase(without.variables.begin() + at);
    std::visit([](auto& values) { values.push_back({}); }, longer.variables[static_cast<std::size_t>(at)].values);
    results::ValueArray& values = other.variables[static_cast<std::size_t>(at)].values;
    const std::size_t size = std::visit([](const auto& held) { return held.size(); }, values);
    if (std::holds_alternative<std::vector<double>>(values))
      values = std::vector<std::int64_t>(size);
    else
      values = std::vector<double>(size);
    EXPECT_NE(refusal(without).find(variable.name), std::string::npos) << variable.name;
    EXPECT_NE(refusal(longer), "") << variable.name;
    EXPECT_NE(refusal(other).find(variable.name), std::string::npos) << variable.name << ": " << refusal(other);
  }
}

TEST(Shard, takes_memory_by_its_points) {
  Sweep sweep = any_sweep();
  sweep.problem.observe.impact_log = sweep.problem.observe.word = false;  // neither has one size for every point
  sweep.problem.observe.attractor = false;
  for (const results::Shard shard : {results::Shard{0, 4}, results::Shard{3, 4}, results::Shard{35, 40}}) {
    double bytes = 0;
    for (const results::Variable& variable : shard_figure(sweep, shard).variables)
      bytes += std::visit([](const auto& held) { return static_cast<double>(held.size() * sizeof held[0]); },
                          variable.values);
    EXPECT_EQ(plan::memory_need(sweep, shard).output, bytes) << shard.number;
  }
}

TEST(SavedRun, goes_on_from_whatever_was_saved_to_the_same_bits) {
  for (const Order& order : {every_order[0], every_order[2], every_order[6]}) {
    Sweep sweep = any_sweep(order);
    sweep.dimensions[1][0].values.resize(2);  // every length of what was saved is tried
    const results::Dataset whole = run(sweep, {.threads = 2}).dataset;
    SweepRun first(sweep);
    EXPECT_TRUE(saved(first).empty());
    first.run({.threads = 2});
    const std::vector<Bytes> pieces = saved(first);
    ASSERT_EQ(pieces.size(), 1u);
    EXPECT_TRUE(saved(first).empty());  // all was saved
    const Bytes& all = pieces[0];
    std::size_t most = 0;
    for (std::size_t length = 0; length <= all.size(); ++length) {
      SweepRun again(sweep);
      const bool fits = again.restore(std::span(all).first(length));
      EXPECT_EQ(fits, length == 0 || again.restored_points() > most || length == all.size()) << length;
      most = std::max(most, again.restored_points());
      if (!fits || again.restored_points() % 3 != 0) continue;
      const std::size_t restored = again.restored_points();
      again.run({.threads = 3});
      std::size_t left = 0;
      for (const WorkStats& part : again.result().work) left += part.points;
      EXPECT_EQ(left, size(sweep) - restored);
    }
    EXPECT_EQ(most, size(sweep));
    SweepRun half(sweep);
    ASSERT_TRUE(half.restore(all));
    half.run({});
    expect_same(dataset_of(half), whole);
  }
}

TEST(SavedRun, refuses_results_that_are_not_its_own) {
  const Sweep sweep = any_sweep();
  SweepRun first(sweep, results::Shard{1, 2});
  first.run({});
  const Bytes bytes = saved(first).at(0);
  SweepRun again(sweep, results::Shard{1, 2});
  EXPECT_TRUE(again.restore(bytes));
  EXPECT_FALSE(again.restore(bytes));  // twice
  EXPECT_FALSE(SweepRun(sweep, results::Shard{1, 4}).restore(bytes));
  Sweep other = sweep;
  other.problem.observe.trajectory = 6;
  EXPECT_FALSE(SweepRun(other, results::Shard{1, 2}).restore(bytes));
}

TEST(SavedRun, may_be_saved_while_it_is_at_work) {
  Sweep alone = any_sweep({2});  // chains of one point
  alone.dimensions[2][0].values.resize(1);
  for (const Sweep& sweep : {any_sweep(), any_sweep({1}), alone}) {
    const results::Dataset whole = run(sweep, {.threads = 1}).dataset;
    for (int round = 0; round < 5; ++round) {
      std::vector<Bytes> pieces;
      SweepRun first(sweep);
      {
        std::jthread saver([&](const std::stop_token& stop) {
          while (!stop.stop_requested())
            for (Bytes& piece : saved(first)) pieces.push_back(std::move(piece));
        });
        first.run({.threads = 2});
      }
      pieces.resize(pieces.size() * static_cast<std::size_t>(round) / 4);
      SweepRun again(sweep);
      for (const Bytes& piece : pieces) ASSERT_TRUE(again.restore(piece));
      again.run({.threads = 2});
      expect_same(dataset_of(again), whole);
    }
  }
}

}  // namespace
}  // namespace clatter::sweep::shard_test
