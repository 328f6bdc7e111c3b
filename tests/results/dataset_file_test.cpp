#include "results/dataset_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "storage/error.hpp"
#include "support/lookup3.hpp"
#include "support/temporary_directory.hpp"

namespace clatter::results::dataset_file_test {
namespace {

class DatasetFile : public testing::Test {
 protected:
  [[nodiscard]] std::string write(const std::string& name, const std::vector<std::byte>& bytes) const {
    return directory_.write(name, bytes);
  }

  /// The error of read_summary for a file, or nothing if it reads the file.
  [[nodiscard]] static std::string refusal(const std::string& file) {
    try {
      static_cast<void>(read_summary(file));
      return "";
    } catch (const storage::IoError& error) {
      return error.what();
    }
  }

  support::TemporaryDirectory directory_;
};

FileHead head(int compression = 4) {
  FileHead given;
  given.title = "Größter Ausschlag";
  given.source = "doi:10.5755/j02.mech.32277";
  given.text = "[scene]\nxs = -4.0\n[sweep]\nnu = [1, 2, 3, 4, 5]\n";
  given.compression = compression;
  return given;
}

std::vector<double> ramp(std::size_t size) {
  std::vector<double> values(size);
  for (std::size_t i = 0; i < size; ++i) values[i] = std::sqrt(static_cast<double>(i));
  return values;
}

const std::vector<std::uint8_t> flags{0, 1, 2, 16, 17, 18};
const std::string meanings = "periodic aperiodic transient event_budget not_finite unresolved";

/// A little-endian number of the file.
std::size_t number_at(const std::vector<std::byte>& bytes, std::size_t place, std::size_t size) {
  std::size_t number = 0;
  for (std::size_t i = size; i-- > 0;) number = number << 8U | std::to_integer<std::size_t>(bytes[place + i]);
  return number;
}

/// A sweep over nu with trajectories: a coordinate, a scale without one, an integer, a float, and flags.
Dataset sweep(std::size_t points, std::size_t samples) {
  std::vector<std::uint8_t> status(points, 0);
  status.front() = 16;
  return {{{"nu", points}, {"sample", samples}},
          {{"nu", {"nu"}, ramp(points), "excitation frequency", "1"},
           {"status", {"nu"}, status, "outcome", "1", {{"flag_values", flags}, {"flag_meanings", meanings}}},
           {"impact_total", {"nu"}, std::vector<std::int64_t>(points, 1LL << 40), "impacts", "1"},
           {"x", {"nu", "sample"}, ramp(points * samples), "displacement", "1"}}};
}

TEST_F(DatasetFile, summary_names_all_that_was_written) {
  const FileSummary summary = read_summary(write("sweep.h5", file_image(sweep(5, 7), head())));
  ASSERT_EQ(summary.variables.size(), 4U);  // `sample` is a dimension, no variable
  EXPECT_EQ(summary.variables[0].name, "nu");
  EXPECT_EQ(summary.variables[1].type, "uint8");
  EXPECT_EQ(summary.variables[2].type, "int64");
  const FileSummary::Entry& x = summary.variables[3];
  EXPECT_EQ(x.name + " " + x.type + " " + x.units + " " + x.long_name, "x float64 1 displacement");
  ASSERT_EQ(x.dimensions.size(), 2U);
  EXPECT_EQ(x.dimensions[0].name, "nu");
  EXPECT_EQ(x.dimensions[1].name, "sample");
  EXPECT_EQ(x.dimensions[1].length, 7U);
}

TEST_F(DatasetFile, root_attributes_come_in_the_order_of_the_contract) {
  const FileSummary summary = read_summary(write("sweep.h5", file_image(sweep(5, 7), head())));
  std::string names;
  for (const auto& [name, text] : summary.attributes) names += name + " ";
  EXPECT_EQ(names, "Conventions title source clatter_schema clatter_version git_commit config config_sha256 compiler ");
  EXPECT_EQ(summary.attributes[0].second, "CF-1.10");
  EXPECT_EQ(summary.attributes[1].second, "Größter Ausschlag");
  EXPECT_EQ(summary.attributes[6].second, "[scene]\nxs = -4.0\n[sweep]\nnu = [1, 2, 3, 4, 5]\n");
  EXPECT_EQ(summary.attributes[7].second,
            "6908d95f47dbf9f66253d392d95c432addd8a28e83a1f8b6243c43f32664d19a");  // sha256sum
}

TEST_F(DatasetFile, points_are_counted_by_status) {
  const FileSummary summary = read_summary(write("sweep.h5", file_image(sweep(5, 7), head())));
  ASSERT_EQ(summary.status_counts.size(), flags.size());
  EXPECT_EQ(summary.status_counts[0], (std::pair<std::string, std::size_t>{"periodic", 4}));
  EXPECT_EQ(summary.status_counts[3], (std::pair<std::string, std::size_t>{"event_budget", 1}));
}

TEST_F(DatasetFile, the_same_figure_gives_the_same_bytes) {
  const Dataset dataset = sweep(501, 64);
  EXPECT_EQ(file_image(dataset, head()), file_image(dataset, head()));
}

TEST_F(DatasetFile, the_file_is_closed_and_ends_where_it_says) {
  for (const int compression : {0, 4}) {
    const std::vector<std::byte> image = file_image(sweep(501, 1000), head(compression));
    ASSERT_EQ(number_at(image, 8, 1), 0U);             // the version of the superblock that the next lines assume
    EXPECT_EQ(number_at(image, 20, 4), 0U);            // not open for writing
    EXPECT_EQ(number_at(image, 40, 8), image.size());  // end of file
  }
}

TEST_F(DatasetFile, a_sweep_without_axes_has_scalars) {
  const Dataset dataset{{}, {{"x_min", {}, std::vector<double>{-0.5}, "least displacement", "1"}}};
  const FileSummary summary = read_summary(write("scalar.h5", file_image(dataset, head())));
  ASSERT_EQ(summary.variables.size(), 1U);
  EXPECT_TRUE(summary.variables[0].dimensions.empty());
  EXPECT_TRUE(summary.status_counts.empty());
}

TEST_F(DatasetFile, an_impact_log_may_be_empty) {
  const Dataset dataset{{{"impact", 0}}, {{"impact_tau", {"impact"}, std::vector<double>{}, "time of impact", "1"}}};
  const FileSummary summary = read_summary(write("log.h5", file_image(dataset, head())));
  ASSERT_EQ(summary.variables.size(), 1U);
  EXPECT_EQ(summary.variables[0].dimensions.front().name, "impact");
  EXPECT_EQ(summary.variables[0].dimensions.front().length, 0U);
}

TEST_F(DatasetFile, a_configuration_may_be_long) {
  FileHead given = head();
  given.text = std::string(300'000, '#');  // an object header holds at most 64 KiB
  const FileSummary summary = read_summary(write("long.h5", file_image(sweep(5, 7), given)));
  EXPECT_TRUE(summary.attributes[6].second == given.text);  // not EXPECT_EQ, which would print both
}

/// Words over nu and R: empty ones, letters beyond ASCII, and one of this many bytes.
Dataset words(std::size_t longest) {
  return {{{"nu", 2}, {"R", 2}},
          {{"impact_word",
            {"nu", "R"},
            std::vector<std::string>{"LU", "", "L*U…", std::string(longest, 'U')},
            "impacts of one period",
            "1"}}};
}

constexpr std::size_t longest = 255;  // bytes of a text

TEST_F(DatasetFile, texts_come_back_as_they_were) {
  const Dataset dataset = words(longest);
  const std::string path = write("words.h5", file_image(dataset, head()));
  EXPECT_EQ(read_variables(path, {"impact_word"}).variables[0].values, dataset.variables[0].values);
  EXPECT_EQ(read_summary(path).variables[0].type, "string");
  EXPECT_EQ(file_image(dataset, head()), file_image(dataset, head()));
}

TEST_F(DatasetFile, texts_that_are_longer_than_any_of_clatter_are_refused) {
  const std::string path = write("long.h5", file_image(words(longest + 1), head()));
  EXPECT_THROW(static_cast<void>(read_variables(path, {"impact_word"})), storage::IoError);
}

TEST_F(DatasetFile, large_arrays_are_deflated_and_small_ones_are_not) {
  const std::size_t plain = file_image(sweep(501, 1000), head(0)).size();
  EXPECT_GT(plain, 501U * 1000U * sizeof(double));
  EXPECT_LT(file_image(sweep(501, 1000), head(4)).size(), plain);
  EXPECT_EQ(file_image(sweep(501, 2), head(4)), file_image(sweep(501, 2), head(0)));
}

TEST_F(DatasetFile, values_lie_in_the_file_as_little_endian_doubles) {
  const Dataset dataset = sweep(501, 2);  // too small to be deflated; copies_test.py reads deflated ones
  const std::vector<std::byte> image = file_image(dataset, head());
  const auto bytes = std::as_bytes(std::span{std::get<std::vector<double>>(dataset.variables.back().values)});
  EXPECT_NE(std::search(image.begin(), image.end(), bytes.begin(), bytes.end()), image.end());
}

TEST_F(DatasetFile, a_figure_that_contradicts_itself_is_a_bug) {
  Dataset dataset = sweep(5, 7);
  dataset.variables[3].values = ramp(34);  // one short
  EXPECT_THROW(static_cast<void>(file_image(dataset, head())), std::logic_error);
  dataset = sweep(5, 7);
  dataset.variables[3].dimensions = {"nu", "impact"};
  EXPECT_THROW(static_cast<void>(file_image(dataset, head())), std::logic_error);
}

TEST_F(DatasetFile, foreign_files_are_refused_in_words) {
  EXPECT_EQ(refusal(directory_.path("none.h5")),
            "'" + directory_.path("none.h5") + "': No such file or directory; check the name");
  EXPECT_EQ(refusal(directory_.path("")), "'" + directory_.path("") + "': is a directory; name a file in it");
  const std::string text = write("text.h5", std::vector<std::byte>(4096, std::byte{'a'}));
  EXPECT_EQ(refusal(text), "'" + text + "': is not an HDF5 file; name an output of clatter");
  EXPECT_NE(refusal(write("empty.h5", {})).find("is not an HDF5 file"), std::string::npos);
  std::vector<std::byte> foreign = file_image(sweep(5, 7), head());
  const auto schema = std::as_bytes(std::span{std::string_view{"clatter/1"}});
  const auto found = std::search(foreign.begin(), foreign.end(), schema.begin(), schema.end());
  ASSERT_NE(found, foreign.end());
  *found = std::byte{'p'};
  EXPECT_NE(refusal(write("foreign.h5", foreign)).find("not one of clatter's"), std::string::npos);
}

TEST_F(DatasetFile, a_truncated_file_is_refused_at_every_length) {
  const std::vector<std::byte> whole = file_image(sweep(5, 7), head());
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    const std::string file = write("cut.h5", {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
    EXPECT_NE(refusal(file), "") << size << " of " << whole.size() << " bytes";
  }
}

TEST_F(DatasetFile, a_damaged_file_is_read_or_refused_but_ends_no_process_and_holds_none_up) {
  const std::vector<std::byte> whole = file_image(sweep(5, 7), head());
  for (std::size_t place = 0; place + 64 < whole.size(); place += 64) {
    std::vector<std::byte> damaged = whole;
    std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(place), 64, std::byte{0});
    static_cast<void>(refusal(write("damaged.h5", damaged)));
  }
}

// HDF5 1.10 divides by the length of a record, here 0; the checksum is right, as in a file damaged on purpose.
TEST_F(DatasetFile, a_file_that_makes_the_library_crash_is_refused) {
  std::vector<std::byte> damaged = file_image(sweep(5, 7), head());
  const auto signature = std::as_bytes(std::span{std::string_view{"BTHD"}});
  const auto found = std::search(damaged.begin(), damaged.end(), signature.begin(), signature.end());
  ASSERT_NE(found, damaged.end());
  constexpr std::size_t record_length = 10, checksum = 34;  // HDF5 file format, III.A.2 "Version 2 B-trees", header
  const std::span<std::byte> tree(found, checksum + 4);
  const auto sum = [&] { return support::lookup3({reinterpret_cast<const std::uint8_t*>(tree.data()), checksum}); };
  std::uint32_t stored = 0;
  std::memcpy(&stored, &tree[checksum], sizeof stored);
  ASSERT_EQ(stored, sum());
  std::fill_n(&tree[record_length], 2, std::byte{0});
  stored = sum();
  std::memcpy(&tree[checksum], &stored, sizeof stored);
  const std::string why = refusal(write("damaged.h5", damaged));
  EXPECT_NE(why.find("it makes the HDF5 library"), std::string::npos) << why;
}

/// The same dataset, whose values are made while it is written, so many bytes at a time.
Dataset made_meanwhile(const Dataset& dataset, std::size_t at_once = made_at_once) {
  Dataset made = dataset;
  for (Variable& variable : made.variables) {
    variable.at_once = at_once;
    std::visit(
        [&variable]<class T>(std::vector<T>& held) {
          variable.next = [values = std::move(held), at = std::ptrdiff_t{0}](std::size_t count) mutable {
            const auto begin = values.begin() + at;
            at += static_cast<std::ptrdiff_t>(count);
            return std::vector<T>(begin, values.begin() + at);
          };
          held.clear();
        },
        variable.values);
  }
  return made;
}

/// Variables of all types over so many points: with 20 of them small, with 40,000 larger than a block.
Dataset every_type(std::size_t points) {
  std::vector<std::uint8_t> bytes(points);
  std::vector<std::int8_t> signs(points);
  std::vector<std::int32_t> numbers(points);
  std::vector<std::int64_t> counts(points);
  std::vector<std::string> words(points);
  for (std::size_t i = 0; i < points; ++i) {
    bytes[i] = static_cast<std::uint8_t>(i % 7), signs[i] = static_cast<std::int8_t>(i % 3);
    numbers[i] = static_cast<std::int32_t>(i * i), counts[i] = static_cast<std::int64_t>(i);
    words[i] = std::string(i % 60, 'L') + std::to_string(i);
  }
  return {{{"x0", points / 20}, {"v0", 20}, {"sample", 9}},
          {{"x0", {"x0"}, ramp(points / 20), "start", "1"},
           {"status", {"x0", "v0"}, bytes, "outcome", "1"},
           {"word", {"x0", "v0"}, words, "impacts", "1"},
           {"sign", {"x0", "v0"}, signs, "stop", "1"},
           {"x", {"x0", "v0", "sample"}, ramp(9 * points), "displacement", "1"},
           {"number", {"x0", "v0"}, numbers, "motion", "1"},
           {"count", {"x0", "v0"}, counts, "impacts", "1"}}};
}

TEST_F(DatasetFile, values_that_are_made_meanwhile_give_the_same_bytes) {
  for (const std::size_t points : {0UL, 20UL, 40'000UL})
    for (const int level : {0, 1}) {
      const Dataset dataset = every_type(points);
      for (const std::size_t at_once : {made_at_once, 99'992UL, 1UL << 30U})
        EXPECT_TRUE(file_image(made_meanwhile(dataset, at_once), head(level)) == file_image(dataset, head(level)))
            << points << ' ' << level << ' ' << at_once;
    }
}

TEST_F(DatasetFile, of_more_texts_than_are_held_in_pages_is_whole) {
  constexpr std::size_t count = 300'000;  // of some 150 bytes
  std::vector<std::string> words(count);
  for (std::size_t i = 0; i < count; ++i) words[i] = std::string(80 + i % 70, 'U') + std::to_string(i);
  const Dataset dataset{{{"x0", count}}, {{"word", {"x0"}, words, "impacts", "1"}}};
  const std::string path = write("texts.h5", file_image(made_meanwhile(dataset), head()));
  EXPECT_TRUE(*values_of<std::string>(read_variables(path, {"word"}), "word") == words);
}

TEST_F(DatasetFile, an_error_while_values_are_made_comes_out_of_it) {
  Dataset dataset = made_meanwhile(every_type(40'000));
  dataset.variables[4].next = [](std::size_t) -> ValueArray { throw std::range_error("no more"); };
  EXPECT_THROW(static_cast<void>(file_image(dataset, head())), std::range_error);
  dataset = made_meanwhile(every_type(40'000));
  dataset.variables[4].next = [](std::size_t count) { return std::vector<double>(count - 1); };
  EXPECT_THROW(static_cast<void>(file_image(dataset, head())), std::logic_error);
}

/// A disk whose writes fail from one on.
class FailingDisk final : public storage::FileWriter {
 public:
  explicit FailingDisk(int good) : good_(good) {}

  void write(std::uint64_t at, std::span<const std::byte> bytes) override {
    if (good_-- <= 0) throw storage::IoError("the disk is full");
    memory_.write(at, bytes);
  }
  void read(std::uint64_t at, std::span<std::byte> bytes) const override { memory_.read(at, bytes); }
  void set_size(std::uint64_t bytes) override { memory_.set_size(bytes); }
  [[nodiscard]] bool failed() const { return good_ < 0; }

 private:
  storage::MemoryWriter memory_;
  int good_;
};

TEST_F(DatasetFile, an_error_of_the_disk_comes_out_of_it_whichever_write_it_meets) {
  const Dataset dataset = every_type(10'000);
  int good = 0;
  for (; good < 1000; ++good) {
    FailingDisk disk(good);
    try {
      write_file(disk, made_meanwhile(dataset, 99'992), head());
      EXPECT_FALSE(disk.failed());
      break;
    } catch (const storage::IoError&) {
      EXPECT_TRUE(disk.failed());
    }
  }
  EXPECT_GT(good, 10);
}

}  // namespace
}  // namespace clatter::results::dataset_file_test
