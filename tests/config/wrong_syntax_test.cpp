#include "config/wrong_table.hpp"

namespace clatter::config::wrong_syntax_test {
namespace {

TEST(Toml, syntax_errors_have_a_place) {
  expect_all("a.toml",
             {
                 {"[scene]\nh = \n", "2:5", "expected value"},
                 {"[scene]\nh 1\n", "2:3", "expected '='"},
                 {"[scene\nh = 1\n", "1:7", "expected ']'"},
                 {"[scene]\nnu = linspace(1, 2, 3)\n", "2:6", "expressions stand in quotes"},
                 {"[scene]\nh = 2*pi\n", "2:6", "expressions stand in quotes"},
                 {"[scene]\nh = 1e400\n", "2:5", "1e400"},
                 {"[scene]\nh = 99999999999999999999\n", "2:5", "the number is too large"},
                 {"[scene]\nh = 1\n[scene]\nf = 1\n", "3:1", "each section and each key is given once"},
                 {"title = \"\\q\"\n", "1:11", "unknown escape sequence"},
                 {"[scene]\nh = 0.1 0.2\n", "2:9", "KEY = VALUE"},
                 {"[scene]\nh = .5\n", "2:5", "expected decimal digit"},
                 {"title = \"\"\"ä\n", "1:13", "encountered end-of-file"},
                 {"[observe]\nextrema = t\n", "2:12", "expected 'true', saw 't\\x0a'"},
                 {"scene = 5\n", "1:1", "unknown key 'scene' before the first section; begin the section with [scene]"},
                 {"[[scene]]\nxs = 1\n", "1:3", "write [scene], in single brackets"},
                 {"[scene]\nxs = 1\n[[sweep]]\nf = [1]\n", "3:3", "write [sweep], in single brackets"},
                 {"[scene]\nxs = 1\n\"\\u0078s\" = 2\n", "3:1", "cannot redefine existing integer '\"\\u0078s\"';"},
                 {"[scene]\nxs = 1\n[scene.nu]\na = 1\n", "3:1", "nu = a table"},
                 {"[time]\nmax_period = 1\n", "2:1", "did you mean 'max_periods'?"},
                 {"[Scene]\nxs = 1\n", "1:2", "unknown section [Scene]; did you mean [scene]?"},
                 {"[physics]\n", "1:2", "expected one of scene, machine, sweep, time, observe, integrator"},
                 {"[scene]\nxs = 1\ntitle = \"a\"\n", "3:1", "it belongs before the first section"},
                 {"[scene]\nxs = 1\nnu = \"2 * pie\"\n", "3:13", "expected the end of the value, found 'e'"},
                 {"[scene]\nxs = 1\nx0 = \"ä*pi\"\n", "3:7", "expected a number"},
                 {"[scene]\nxs = 1\x01\n", "2:7", "a control character"},
                 {"title = \"ä\" x\n", "1:13", ""},
                 {"[time]\nmode = \"stedy\"\n", "2:8", "did you mean 'steady'?"},
                 {"[scene]\nxs = 1\n[sweep]\nnu = [1, [2]]\n", "4:10", "nu = a list"},
             });
}

TEST(Ini, is_known_by_the_ending_of_the_name_in_any_case) {
  for (const char* name : {"a.ini", "a.INI", "a.Ini"}) EXPECT_EQ(mistake_in(name, "[scene]\nxs = 1 ; INI\n"), "");
  const std::string hint = "; read as TOML; for INI give --ini, or a name that ends in .ini";
  for (const char* text : {"[scene]\nxs = 1 ; INI\n", "title = Größe\n", "[sweep]\nnu = linspace(1, 2, 3)\n"}) {
    for (const char* name : {"a.cfg", "ini"}) EXPECT_TRUE(mistake_in(name, text).ends_with(hint)) << text;
    for (const char* name : {"a.toml", "a.TOML"}) EXPECT_FALSE(mistake_in(name, text).ends_with(hint)) << text;
  }
  EXPECT_FALSE(mistake_in("a.cfg", "[scene]\nxs = 0\n").ends_with(hint));  // this is TOML
}

TEST(Ini, syntax_errors_have_a_place) {
  expect_all("a.ini",
             {
                 {"[scene]\nh = \n", "2:4", "h = nothing; expected >= 0"},
                 {"[scene]\n  h 1\n", "2:3", "expected KEY = VALUE or [section], found 'h 1'"},
                 {"[scene\nh = 1\n", "1:1", "the section's ']' is missing"},
                 {"[]\nh = 1\n", "1:1", "a section without a name"},
                 {"[scene] h = 1\n", "1:9", "begin a new line"},
                 {"[scene]\nxs = 1\n[time]\n[ scene ]\nf = 1\n", "4:3", "section [scene] again; it began at line 1"},
                 {"[scene]\nf = 1\n\n f = 2\n", "4:2", "key 'f' again; it was given at line 2"},
                 {"[scene]\n = 1\n", "2:2", "a key is missing before '='"},
                 {"[scene]\nh # = 1\n", "2:1", "expected KEY = VALUE"},
                 {"title = \"a\n", "1:9", "the closing quote is missing"},
                 {"title = \"a\" b\n", "1:13", "text after the closing quote"},
                 {"[scene]\nnu = 0.5 x\n", "2:10", "expected the end of the value, found 'x'"},
                 {"[scene]\r\nxs = 1\r\nnuu = 1\r\n", "3:1", "did you mean 'nu'?"},
                 {"\xEF\xBB\xBF[scen]\n", "1:2", "unknown section [scen]; did you mean [scene]?"},
                 {"title = ü\n[scene]\nxs = ü\n", "3:6", "expected a number"},
                 {"title = ü\x02\n", "1:10", "a control character"},
                 {"h = 1\n", "1:1", "unknown key 'h' before the first section; it belongs in [scene]"},
                 {"[time]\nmode = stedy\n", "2:8", "did you mean 'steady'?"},
                 {"[time]\nmax_periods = 1_000\n", "2:16", "expected the end of the value"},
             });
}

TEST(Ini, comments_and_quotes_are_told_from_text) {
  const Config config =
      read_as("a.ini", "title = 'a # b; c' ; d\nsource = http://x.org/#a;b # c\n[scene] ; e\nxs = 1;f\n#g\n;h = 1\n");
  EXPECT_EQ(config.title, "a # b; c");
  EXPECT_EQ(config.source, "http://x.org/#a;b");
}

}  // namespace
}  // namespace clatter::config::wrong_syntax_test
