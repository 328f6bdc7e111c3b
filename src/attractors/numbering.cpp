#include "attractors/numbering.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "attractors/tracked_motion.hpp"
#include "scene/scene.hpp"

namespace clatter::attractors {
namespace {

/// A motion of one ensemble. All of the same number make a ring.
struct Instance {
  SectionState state{};
  std::size_t example = 0;  ///< its first point
  std::size_t ensemble = 0;
  std::uint32_t periods = 0;
  std::uint32_t parent = 0;  ///< towards the instance that stands for all of the same number
  std::uint32_t next = 0;    ///< in the ring
};

static_assert(sizeof(Instance) == bytes_of_motion);

class Numberer {
 public:
  explicit Numberer(const Endings& endings)
      : endings_(endings), grid_(endings.grid), number_(endings.count, undecided), begins_(grid_.ensembles() + 1, 0) {}

  Numbering run() {
    collect(find_along_first_dimension());
    for (std::size_t dimension = 1; dimension < grid_.lengths().size(); ++dimension) join_along(dimension);
    return number();
  }

 private:
  /// The instances of a line of ensembles along the first dimension, in its order.
  struct Line {
    std::vector<Instance> instances;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> same;  ///< pairs that one motion passes
  };

  /// A motion on its way along a line, and the instance that it was seen in last.
  struct Traveller {
    TrackedMotion motion;
    std::uint32_t instance;
  };

  [[nodiscard]] std::size_t first_length() const { return grid_.lengths().empty() ? 1 : grid_.lengths().front(); }
  [[nodiscard]] std::size_t lines() const { return grid_.ensembles() / first_length(); }

  [[nodiscard]] point::Problem parameters_of(std::size_t ensemble) const {
    return endings_.problem(grid_.point(ensemble, 0));
  }

  /// Finds the motions of every ensemble, and follows them along the lines. If there are few lines, threads share the
  /// ensembles of each.
  std::vector<Line> find_along_first_dimension() {
    constexpr std::size_t many_lines = 16;
    std::vector<Line> found(lines());
    const bool apart = lines() >= many_lines;
    const auto one_by_one = [](std::size_t count, const std::function<void(std::size_t)>& work) {
      for (std::size_t i = 0; i < count; ++i) work(i);
    };
    (apart ? endings_.for_each : one_by_one)(
        lines(), [&](std::size_t line) { found[line] = run_line(line, apart ? one_by_one : endings_.for_each); });
    return found;
  }

  template <class ForEach>
  Line run_line(std::size_t line_number, const ForEach& for_each) {
    constexpr std::size_t at_once = 64;  // ensembles whose motions are held
    Line line;
    std::vector<Traveller> travellers;
    for (std::size_t begin = 0; begin < first_length(); begin += at_once) {
      const std::size_t count = std::min(at_once, first_length() - begin);
      std::vector<EnsembleMotions> motions(count, EnsembleMotions(grid_.starts() > 1));
      std::vector<std::vector<std::size_t>> examples(count);
      const auto ensemble = [&](std::size_t i) { return line_number + (begin + i) * lines(); };
      for_each(count, [&](std::size_t i) { examples[i] = label(ensemble(i), motions[i]); });
      for (std::size_t i = 0; i < count; ++i) travel(ensemble(i), motions[i], examples[i], line, travellers);
    }
    return line;
  }

  /// Labels the points of an ensemble by the indices of its motions; returns the first point of each.
  std::vector<std::size_t> label(std::size_t ensemble, EnsembleMotions& motions) {
    std::vector<std::size_t> examples;
    std::optional<point::Problem> problem;
    for (std::size_t start = 0; start < grid_.starts(); ++start) {
      const std::size_t point = grid_.point(ensemble, start);
      const auto index = endings_.index(point);
      if (!index) continue;
      if (!problem || endings_.has_phases) problem = endings_.problem(point);
      const auto motion = motions.motion_of(*problem, endings_.ending(*index));
      if (!motion) continue;
      if (*motion == examples.size()) examples.push_back(point);
      number_[*index] = static_cast<std::int32_t>(*motion);
    }
    return examples;
  }

  /// Takes all motions on the way to the next ensemble of a line.
  void travel(std::size_t ensemble, const EnsembleMotions& motions, const std::vector<std::size_t>& examples,
              Line& line, std::vector<Traveller>& travellers) {
    const auto first = static_cast<std::uint32_t>(line.instances.size());
    if (first_length() == 1 && motions.motions().empty()) return;
    const point::Problem problem = parameters_of(ensemble);
    for (std::size_t i = 0; i < motions.motions().size(); ++i) {
      const Motion& motion = motions.motions()[i];
      line.instances.push_back({.state = motion.state,
                                .example = examples[i],
                                .ensemble = ensemble,
                                .periods = static_cast<std::uint32_t>(motion.periods())});
    }
    std::vector<char> is_known(motions.motions().size(), 0);
    std::vector<Traveller> next;
    for (Traveller& traveller : travellers) {
      if (!traveller.motion.follow(problem)) continue;
      const auto met = traveller.motion.among(motions);
      if (!met) {
        if (traveller.motion.is_periodic()) next.push_back(std::move(traveller));  // no start ends in it here
        continue;
      }
      if (std::exchange(is_known[*met], char{1}) != 0) continue;
      const std::uint32_t instance = first + static_cast<std::uint32_t>(*met);
      line.same.emplace_back(traveller.instance, instance);
      next.push_back({TrackedMotion(problem, motions.motions()[*met]), instance});
    }
    if (first_length() > 1)
      for (std::size_t i = 0; i < is_known.size(); ++i)
        if (is_known[i] == 0)
          next.push_back({TrackedMotion(problem, motions.motions()[i]), first + static_cast<std::uint32_t>(i)});
    travellers = std::move(next);
  }

  /// Puts the instances of all lines into the order of the ensembles.
  void collect(const std::vector<Line>& found) {
    for (const Line& line : found)
      for (const Instance& instance : line.instances) ++begins_[instance.ensemble + 1];
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    instances_.resize(begins_.back());
    std::vector<std::uint32_t> places;
    for (const Line& line : found) {
      places.clear();
      for (const Instance& instance : line.instances) {
        const bool first = places.empty() || instances_[places.back()].ensemble != instance.ensemble;
        places.push_back(first ? begins_[instance.ensemble] : places.back() + 1);
        instances_[places.back()] = instance;
        instances_[places.back()].parent = instances_[places.back()].next = places.back();
      }
      for (const auto& [one, other] : line.same) join(places[one], places[other]);
    }
  }

  [[nodiscard]] std::uint32_t root_of(std::uint32_t instance) {
    while (instances_[instance].parent != instance)
      instance = instances_[instance].parent = instances_[instances_[instance].parent].parent;
    return instance;
  }

  /// Whether an ensemble has an instance with the same number as another one.
  [[nodiscard]] bool has(std::size_t ensemble, std::uint32_t root) {
    for (std::uint32_t i = begins_[ensemble]; i < begins_[ensemble + 1]; ++i)
      if (root_of(i) == root) return true;
    return false;
  }

  /// Gives two instances, and all of their numbers, one number.
  void join(std::uint32_t one, std::uint32_t other) {
    const std::uint32_t root = root_of(one);
    instances_[root_of(other)].parent = root;
    std::swap(instances_[one].next, instances_[other].next);
  }

  /// Whether no ensemble has motions of both numbers.
  [[nodiscard]] bool may_join(std::uint32_t one, std::uint32_t other) {
    // both rings are walked in step, so that the shorter one decides how long that takes
    std::uint32_t a = one, b = other;
    do {
      if (has(instances_[a].ensemble, root_of(other)) || has(instances_[b].ensemble, root_of(one))) return false;
      a = instances_[a].next, b = instances_[b].next;
    } while (a != one && b != other);
    return true;
  }

  /// Joins the numbers of motions that can be followed along another dimension.
  void join_along(std::size_t dimension) {
    std::size_t stride = 1;
    for (std::size_t d = dimension + 1; d < grid_.lengths().size(); ++d) stride *= grid_.lengths()[d];
    for (std::size_t ensemble = 0; ensemble + stride < grid_.ensembles(); ++ensemble) {
      const std::size_t to = ensemble + stride;
      if (ensemble / stride % grid_.lengths()[dimension] + 1 == grid_.lengths()[dimension]) continue;
      for (std::uint32_t i = begins_[ensemble]; i < begins_[ensemble + 1]; ++i)
        if (begins_[to] < begins_[to + 1] && !has(to, root_of(i))) join_to(i, to);
    }
  }

  void join_to(std::uint32_t instance, std::size_t ensemble) {
    const std::size_t from = instances_[instance].ensemble;
    TrackedMotion motion(parameters_of(from), found_again(from).motions()[instance - begins_[from]]);
    if (!motion.follow(parameters_of(ensemble))) return;
    const auto met = motion.among(found_again(ensemble));
    if (!met) return;
    const std::uint32_t other = begins_[ensemble] + static_cast<std::uint32_t>(*met);
    if (may_join(instance, other)) join(instance, other);
  }

  /// The motions of an ensemble found again, from its instances, which keep no more than their states; in their order.
  [[nodiscard]] EnsembleMotions found_again(std::size_t ensemble) const {
    EnsembleMotions motions(grid_.starts() > 1);
    const point::Problem problem = parameters_of(ensemble);
    for (std::uint32_t i = begins_[ensemble]; i < begins_[ensemble + 1]; ++i) motions.restore(problem, state_of(i));
    return motions;
  }
  [[nodiscard]] Ending state_of(std::uint32_t instance) const {
    return {instances_[instance].state, static_cast<double>(instances_[instance].periods)};
  }

  Numbering number() {
    std::vector<std::uint32_t> firsts(instances_.size(), none);  // [root]: the instance with the first point
    for (std::uint32_t i = 0; i < instances_.size(); ++i) {
      std::uint32_t& first = firsts[root_of(i)];
      if (first == none || instances_[i].example < instances_[first].example) first = i;
    }
    std::vector<std::uint32_t> order;
    for (const std::uint32_t first : firsts)
      if (first != none) order.push_back(first);
    std::ranges::sort(order, {}, [&](std::uint32_t first) { return instances_[first].example; });
    std::vector<std::int32_t> numbers(instances_.size(), undecided);  // [root]
    for (std::size_t i = 0; i < order.size(); ++i) numbers[root_of(order[i])] = static_cast<std::int32_t>(i);
    Numbering numbering{.number = std::move(number_), .motions = std::vector<NumberedMotion>(order.size())};
    for (std::size_t ensemble = 0; ensemble < grid_.ensembles(); ++ensemble)
      for (std::size_t start = 0; start < grid_.starts(); ++start) {
        const auto index = endings_.index(grid_.point(ensemble, start));
        if (!index || numbering.number[*index] == undecided) continue;
        const auto motion = static_cast<std::uint32_t>(numbering.number[*index]);
        numbering.number[*index] = numbers[root_of(begins_[ensemble] + motion)];
        ++numbering.motions[static_cast<std::size_t>(numbering.number[*index])].points;
      }
    endings_.for_each(order.size(), [&](std::size_t i) { describe(order[i], numbering.motions[i]); });
    find_mirrors(order, numbers, numbering.motions);
    return numbering;
  }

  void describe(std::uint32_t instance, NumberedMotion& numbered) const {
    const std::size_t ensemble = instances_[instance].ensemble;
    const Motion motion = found_again(ensemble).motions()[instance - begins_[ensemble]];
    numbered.example = instances_[instance].example;
    numbered.periods = motion.periods(), numbered.state = instances_[instance].state;
    if (motion.periodic) numbered.word = motion.periodic->word, numbered.regime = motion.periodic->regime;
    numbered.has_mirror = is_symmetric(parameters_of(ensemble));
  }

  /// Looks for the mirror image of each motion in an ensemble that has both.
  void find_mirrors(const std::vector<std::uint32_t>& order, const std::vector<std::int32_t>& numbers,
                    std::vector<NumberedMotion>& motions) {
    for (std::size_t i = 0; i < order.size(); ++i) {
      std::uint32_t instance = order[i];
      do {
        if (!motions[i].has_mirror || motions[i].mirror != undecided) break;
        const std::size_t ensemble = instances_[instance].ensemble;
        const bool alone = begins_[ensemble + 1] - begins_[ensemble] == 1;
        if (!alone || instance == order[i]) {
          if (const auto mirror = mirror_of(instance)) {
            motions[i].mirror = numbers[root_of(*mirror)];
            motions[static_cast<std::size_t>(motions[i].mirror)].mirror = static_cast<std::int32_t>(i);
          }
        }
        instance = instances_[instance].next;
      } while (instance != order[i]);
    }
  }

  /// The instance of the same ensemble that is the mirror image of another one.
  [[nodiscard]] std::optional<std::uint32_t> mirror_of(std::uint32_t instance) const {
    const std::size_t ensemble = instances_[instance].ensemble;
    const EnsembleMotions motions = found_again(ensemble);
    const Motion& motion = motions.motions()[instance - begins_[ensemble]];
    const point::Problem problem = motion.floats ? floating(parameters_of(ensemble)) : parameters_of(ensemble);
    const auto state = mirrored(problem, instances_[instance].state);
    if (!state) return std::nullopt;
    std::optional<std::size_t> met;
    if (instances_[instance].periods > 0) {
      met = motions.passing(*state);
    } else if (motion.symmetric) {
      return instance;
    } else if (auto sections = run_sections(started(problem, *state, 0.0), VisitedCells::long_look)) {
      if (motion.floats) forget_places(sections->states);
      met = motions.visiting(sections->states, motion.floats);
    }
    return met ? std::optional(begins_[ensemble] + static_cast<std::uint32_t>(*met)) : std::nullopt;
  }

  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  const Endings& endings_;
  const Grid& grid_;
  std::vector<std::int32_t> number_;   ///< [index]: at first the index of the motion in its ensemble
  std::vector<std::uint32_t> begins_;  ///< [ensemble]: its first instance; one more at the end
  std::vector<Instance> instances_;    ///< by ensemble
};

}  // namespace

Grid::Grid(std::vector<Dimension> dimensions) : dimensions_(std::move(dimensions)) {
  for (const Dimension& dimension : dimensions_) {
    (dimension.of_start ? starts_ : ensembles_) *= dimension.length;
    if (!dimension.of_start) lengths_.push_back(dimension.length);
  }
}

std::size_t Grid::point(std::size_t ensemble, std::size_t start) const {
  std::size_t point = 0, stride = 1;
  for (std::size_t i = dimensions_.size(); i-- > 0;) {
    std::size_t& left = dimensions_[i].of_start ? start : ensemble;
    point += left % dimensions_[i].length * stride;
    left /= dimensions_[i].length, stride *= dimensions_[i].length;
  }
  return point;
}

Numbering number_motions(const Endings& endings) { return Numberer(endings).run(); }

}  // namespace clatter::attractors
