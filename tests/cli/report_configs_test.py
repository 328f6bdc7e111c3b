"""Every shipped configuration has a report, whose data is JSON and whose commands give the numbers of their points."""

import unittest

from report_runs import ReportRuns
from shipped import shipped


class Configs(ReportRuns):
    def test_points_of_every_shipped_configuration_are_repeated(self):
        for config, command, sets in shipped():
            with self.subTest(config.name):
                self.run_config(config, f"{config.name}.h5", *sets, command=command)
                self.check(f"{config.name}.h5")


if __name__ == "__main__":
    unittest.main()
