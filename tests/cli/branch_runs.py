"""Runs of `clatter branch`, shared by the tests of what it writes and of its pictures."""

from command_line import CommandLine

SCENE = "[scene]\nh = 0.1\nf = -1.0\nR = 0.7\nxs = -3\nnu = 1.1\nx0 = 2\nv0 = 3\n"
BRANCH = '[branch]\nalong = "nu"\nrange = [0.85, 1.5]\n'
WIDE = '[branch]\nalong = "nu"\nrange = [0.5, 2]\n'


class BranchRuns(CommandLine):
    def branch(self, text, *words):
        self.write("a.toml", text)
        return self.clatter("branch", "a.toml", *words)
