"""An output may replace an older one of the same command, shard and title; with --force, anything."""

import shutil
import unittest

import h5py

from command_line import SMALL, SOURCE, CommandLine

# Over in no time, since all of it fails.
ACCURACY = SMALL.partition("[sweep]")[0].replace("xs = -4.0", "xs = -0.5") + "[time]\nwindow = 1\nmax_impacts = 1\n"
REMEDY = "name another with -o, e.g. -o {}, move that one away, or replace it with --force"


def second(name):
    """mine-2.h5 for mine.h5"""
    stem, dot, ending = name.rpartition(".")
    return f"{stem}-2.{ending}" if dot else f"{name}-2"


class Replace(CommandLine):
    def setUp(self):
        super().setUp()
        self.config = self.write("a.toml", SMALL)

    def ok(self, *words, code=0):
        result = self.clatter(*words)
        self.assertEqual(result.returncode, code, (words, result.stderr))

    def assert_kept(self, name, why, *command):
        """The command is refused before it does anything, since a file would be lost; with --force it isn't."""
        before = (self.directory / name).read_bytes()
        self.assert_refused(74, f"cannot write '{name}': {why}; {REMEDY.format(second(name))}", *command)
        self.assertEqual((self.directory / name).read_bytes(), before)
        result = self.clatter(*command, "--force", "-q")
        self.assertIn(result.returncode, (0, 1), result.stderr)
        self.assertNotEqual((self.directory / name).read_bytes(), before)

    def test_another_configuration_is_kept(self):
        shutil.copy(SOURCE / "configs" / "fig18.toml", self.directory / "keep")
        self.assert_kept(
            "keep",
            "the file there is not an output of clatter, or is damaged",
            "run",
            SOURCE / "configs" / "fig18.toml",
            "-o",
            "keep",
        )

    def test_files_that_are_no_whole_output_are_kept(self):
        self.ok("run", self.config)
        whole = (self.directory / "a.h5").read_bytes()
        with h5py.File(self.directory / "foreign.h5", "w") as file:
            file["nu"] = [1.0, 2.0]
            file.attrs["title"] = "a small sweep"
        (self.directory / "cut.h5").write_bytes(whole[: len(whole) // 2])
        self.write("text.h5", "a letter")
        (self.directory / "link.h5").symlink_to("letter")
        self.write("letter", "another letter")
        for name in ("foreign.h5", "cut.h5", "text.h5", "link.h5"):
            for words in (("run", self.config), ("accuracy", self.write("b.toml", ACCURACY))):
                content = (self.directory / name).read_bytes()
                self.assert_kept(name, "the file there is not an output of clatter, or is damaged", *words, "-o", name)
                (self.directory / name).write_bytes(content)

    def test_an_empty_file_holds_nothing_that_could_be_lost(self):
        self.write("a.h5", "")
        self.ok("run", self.config)

    def test_an_output_of_another_title_is_kept(self):
        self.ok("run", self.config)
        self.assert_kept(
            "a.h5",
            "the file there has the title 'a small sweep', this one 'another'",
            "run",
            self.config,
            "--set",
            "title=another",
        )

    def test_the_same_sweep_with_other_values_is_run_again(self):
        for words in ((), ("--set", "scene.R=0.5"), ("--set", "observe.period=false", "-o", "a.h5"), ("--force",)):
            before = (self.directory / "a.h5").read_bytes() if words else b""
            self.ok("run", self.config, *words)
            self.assertNotEqual((self.directory / "a.h5").read_bytes(), before)

    def test_a_run_and_an_accuracy_run_have_files_of_their_own_and_keep_each_others(self):
        config = self.write("b.toml", ACCURACY)
        for _ in range(2):
            self.ok("run", config, code=1)
            self.ok("accuracy", config, code=1)
        self.assertEqual(self.files(), ["a.toml", "b.accuracy.h5", "b.h5", "b.toml"])
        self.assert_kept(
            "b.h5",
            "the file there is an output of `clatter run`, this is one of `clatter accuracy`",
            "accuracy",
            config,
            "-o",
            "b.h5",
        )
        self.assert_kept(
            "b.h5", "the file there is an output of `clatter accuracy`, this is one of `clatter run`", "run", config
        )

    def test_shards_and_the_whole_keep_each_other(self):
        for k in range(2):
            for _ in range(2):
                self.ok("run", self.config, "--shard", f"{k}/2")
        shards = ("a.0-of-2.h5", "a.1-of-2.h5")
        for _ in range(2):
            self.ok("merge", "-o", "a.h5", *shards)
        self.ok("run", self.config)
        self.ok("merge", "-o", "a.h5", *shards)
        self.assert_kept(
            shards[0],
            "the file there has shard 0/2 of a sweep, this one shard 1/2",
            "run",
            self.config,
            "--shard",
            "1/2",
            "-o",
            shards[0],
        )
        self.assert_kept(
            "a.h5",
            "the file there has all points of a sweep, this one shard 1/2",
            "run",
            self.config,
            "--shard",
            "1/2",
            "-o",
            "a.h5",
        )
        self.ok("run", self.config, "--shard", "0/2", "--force")
        self.assert_kept(
            "a.h5", "the file there has shard 1/2 of a sweep, this one all points", "merge", "-o", "a.h5", *shards
        )
        self.write("letter", "not to be lost")
        self.assert_kept(
            "letter", "the file there is not an output of clatter, or is damaged", "merge", "-o", "letter", *shards
        )

    def test_the_name_that_is_offered_is_free_and_works(self):
        self.ok("run", self.config)
        other = ("run", self.config, "--set", "title=another")
        self.write("a-2.h5", "")
        (self.directory / "a-3.h5").symlink_to("nothing")
        self.write("a-4.h5.journal", "")
        self.assert_refused(74, "e.g. -o a-5.h5, move", *other)
        self.ok(*other, "-o", "a-5.h5")
        self.assert_refused(74, "e.g. -o a-6.h5, move", *other)
        (self.directory / "my own").mkdir()
        self.write("my own/a.h5", "a letter")
        self.assert_refused(74, "e.g. -o 'my own/a-2.h5', move", *other, "-o", "my own/a.h5")

    def test_inputs_are_never_replaced(self):
        self.assert_refused(2, "is the configuration itself", "run", self.config, "-o", self.config, "--force")
        self.ok("run", self.config, "--shard", "0/1")
        self.assert_refused(2, "is one of the shards", "merge", "a.0-of-1.h5", "-o", "a.0-of-1.h5", "--force")


if __name__ == "__main__":
    unittest.main()
