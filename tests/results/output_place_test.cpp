#include "results/output_place.hpp"

#include <gtest/gtest.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "results/dataset_file.hpp"
#include "storage/error.hpp"
#include "support/temporary_directory.hpp"

namespace clatter::results::output_place_test {
namespace {

namespace fs = std::filesystem;

class OutputPlaceTest : public testing::Test {
 protected:
  [[nodiscard]] std::string path() const { return directory_.path("out.h5"); }
  [[nodiscard]] std::size_t files() const { return directory_.entries(); }
  [[nodiscard]] std::string content() const { return directory_.content("out.h5"); }
  void write(const std::string& content) const { directory_.write("out.h5", content); }

 private:
  support::TemporaryDirectory directory_;
};

/// The bytes of an output: of a run, of a shard, or, with its variable of times, of an accuracy run.
std::string output(const Origin& origin) {
  FileHead head;
  head.title = origin.title;
  results::Dataset dataset{
      {}, {{origin.command == "accuracy" ? "ns_per_period" : "x_min", {}, std::vector<double>{1.0}, "", "1"}}};
  if (!origin.shard.empty()) dataset.attributes = {{"shard", origin.shard}};
  const std::vector<std::byte> bytes = file_image(std::move(dataset), head);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

const Origin run{.title = "größter Ausschlag"}, accuracy{.command = "accuracy", .title = run.title},
    shard{.shard = "1/3", .title = run.title}, other{.title = "another"};

void publish_new(const OutputPlace& place) {
  const std::string bytes = "new";
  place.write_atomically([&](storage::FileWriter& file) { file.write(0, std::as_bytes(std::span(bytes))); });
}

TEST_F(OutputPlaceTest, an_output_tells_its_origin) {
  for (const Origin& origin : {run, accuracy, shard, other, Origin{}}) {
    write(output(origin));
    EXPECT_EQ(origin_of(path()), origin) << origin.title;
  }
}

TEST_F(OutputPlaceTest, foreign_files_have_no_origin) {
  EXPECT_EQ(origin_of(path()), std::nullopt);
  write("[scene]\nxs = 1\n");
  EXPECT_EQ(origin_of(path()), std::nullopt);
  std::string foreign = output(run);
  foreign.replace(foreign.find("clatter/1"), 9, "flatter/1");
  write(foreign);
  EXPECT_EQ(origin_of(path()), std::nullopt);
}

TEST_F(OutputPlaceTest, of_a_truncated_output_no_length_has_an_origin) {
  const std::string whole = output(run);
  for (std::size_t size = 0; size < whole.size(); size += 61) {
    write(whole.substr(0, size));
    EXPECT_EQ(origin_of(path()), std::nullopt) << size << " of " << whole.size() << " bytes";
  }
}

TEST_F(OutputPlaceTest, a_damaged_output_ends_no_process_and_holds_none_up) {
  const std::string whole = output(run);
  for (std::size_t place = 0; place < whole.size(); place += 64) {
    std::string damaged = whole;
    damaged.replace(place, std::min<std::size_t>(64, whole.size() - place), 64, '\0');
    write(damaged);
    EXPECT_NO_THROW(static_cast<void>(origin_of(path()))) << place;
  }
}

TEST_F(OutputPlaceTest, every_origin_gives_way_to_itself_alone) {
  const std::vector<Origin> origins{run, accuracy, shard, other};
  for (const Origin& there : origins)
    for (const Origin& ours : origins) {
      write(output(there));
      if (there == ours) {
        publish_new(OutputPlace(path(), ours, false));
        EXPECT_EQ(content(), "new");
      } else {
        EXPECT_THROW(OutputPlace(path(), ours, false), storage::IoError);
        EXPECT_EQ(content(), output(there));
      }
    }
}

TEST_F(OutputPlaceTest, force_replaces_anything) {
  write("a letter");
  publish_new(OutputPlace(path(), run, true));
  EXPECT_EQ(content(), "new");
}

TEST_F(OutputPlaceTest, a_file_that_has_come_meanwhile_is_kept) {
  const OutputPlace place(path(), run, false);
  write("a letter");
  EXPECT_THROW(publish_new(place), storage::IoError);
  EXPECT_EQ(content(), "a letter");
  EXPECT_EQ(files(), 1U);  // no temporary one
}

TEST_F(OutputPlaceTest, an_output_that_has_become_another_file_meanwhile_is_kept) {
  write(output(run));
  const OutputPlace place(path(), run, false);
  write("a letter");
  EXPECT_THROW(publish_new(place), storage::IoError);
  EXPECT_EQ(content(), "a letter");
}

TEST_F(OutputPlaceTest, an_output_of_the_same_origin_that_has_come_meanwhile_gives_way) {
  const OutputPlace place(path(), run, false);
  write(output(run));
  publish_new(place);
  EXPECT_EQ(content(), "new");
}

TEST_F(OutputPlaceTest, a_title_is_shown_without_its_control_characters) {
  write(output({.title = "a\x1b]0;b\n"}));
  try {
    const OutputPlace place(path(), run, false);
    ADD_FAILURE() << "not refused";
  } catch (const storage::IoError& error) {
    EXPECT_NE(std::string(error.what()).find("'a\\x1b]0;b\\x0a'"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace clatter::results::output_place_test
