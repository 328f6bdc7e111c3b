"""What files say of a loose mass: it strikes walls, where other scenes have stops.

Environment: CLATTER, the program.
"""

import unittest

import h5py

from runs import RunTest

HOUSING = "[scene]\nh = 0.02\nf = 0.3\nnu = 1.3\nloose_mass = 0.05\nloose_gap = 1.9\n"
STOPS = "[scene]\nh = 0.02\nf = 0.3\nnu = 1.3\nxs = 1.9\n"
OBSERVE = "[time]\nmax_periods = 20\n[observe]\nimpacts = true\n"


class Words(RunTest):
    def long_name(self, scene, result):
        with h5py.File(self.run_clatter(scene + OBSERVE)) as file:
            return file[result].attrs["long_name"]

    def test_a_wall_presses_a_loose_mass_and_a_mass_rests_on_a_stop(self):
        self.assertEqual(self.long_name(HOUSING, "rest_fraction"), "share of time pressed on the wall")
        self.assertEqual(self.long_name(STOPS, "rest_fraction"), "share of time at rest on the stop")


if __name__ == "__main__":
    unittest.main()
