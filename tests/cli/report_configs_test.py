"""Every shipped configuration has a report, whose data is JSON and whose commands give the numbers of their points.

Figures of the paper are drawn by other tests: their reports have no pictures here.
"""

import contextlib
import unittest
from unittest import mock

from report_runs import NO_PICTURE, ReportRuns
from shipped import shipped


class Configs(ReportRuns):
    def test_points_of_every_shipped_configuration_are_repeated(self):
        undrawn = mock.patch("clatter.reports.page.picture", return_value=NO_PICTURE)
        for config, command, sets in shipped():
            is_figure = config.name.startswith("fig")
            with self.subTest(config.name), undrawn if is_figure else contextlib.nullcontext():
                self.run_config(config, f"{config.name}.h5", *sets, command=command)
                self.check(f"{config.name}.h5")


if __name__ == "__main__":
    unittest.main()
