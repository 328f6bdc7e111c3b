"""Shared by the tests of failing calls and full disks: a sweep, its bytes, and the library that makes calls fail."""

import os
import unittest

from small_disk import small_disk
from stopped_runs import StoppedRuns

SHIM = os.environ.get("CLATTER_FAULTS")

needs_shim = unittest.skipUnless(SHIM, "calls can't be made to fail under a sanitizer")


def shim_for(test):
    """The library for LD_PRELOAD, in which a blank ends a path: by a link beside the folder of a test."""
    link = test.directory.with_suffix(".so")
    link.symlink_to(SHIM or "none")
    test.addCleanup(link.unlink)
    return str(link)


class FaultyCalls(StoppedRuns):
    def setUp(self):
        super().setUp()
        self.sweep(nu=20, xs=25)
        self.whole = self.undisturbed()
        self.marker = self.directory.with_suffix(".happened")
        self.shim = shim_for(self)

    def small_disk(self, kibibytes):
        return small_disk(self.directory.with_suffix(".disk"), kibibytes)
