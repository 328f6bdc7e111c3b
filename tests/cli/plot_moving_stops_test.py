"""Pictures of motion between stops that move by themselves: the mass meets them where they are drawn.

Environment: CLATTER, the program; CLATTER_SOURCE, the source directory.
"""

import unittest

import numpy as np

from plot_pictures import PlotFolder

from clatter.plots.data import Output
from clatter.plots.motion import motion, path_of_stop

SCENES = {
    "both": "[scene]\nh = 0.05\nf = 0.8\nnu = 1.3\nphase = 0.4\nstop_lower = -0.5\nstop_upper = 0.6\nR = 0.7\n"
    "stop_amplitude_lower = 0.1\nstop_phase_lower = 0.7\nstop_amplitude_upper = 0.05\nstop_phase = 0.3\n",
    "table": "[machine]\nmass = '1 g'\nload = '-9.81 mN'\nfrequency = '25 Hz'\nphase = 0.5\nx0 = '4 mm'\n"
    "stop_lower = 0\nstop_upper = '12 mm'\nstop_amplitude_lower = '2 mm'\nR_lower = 0.7\nR_upper = 0.5\n",
}


class MovingStops(PlotFolder):
    def test_a_mass_touches_the_stops_where_they_are_drawn(self):
        for name, scene in SCENES.items():
            self.make("run", name, scene + "[observe]\ntrajectory = 4001\nimpact_log = true\n")
            output = Output(self.folder / f"{name}.h5")
            tau, x, _ = motion(output, ())
            self.assertEqual(len(tau), 4001)  # velocities of impacts are relative to the stop, so none is put in
            sides = output.values("impact_stop")
            for side, sign in ((0, 1), (1, -1)):
                path = path_of_stop(output, side, (), tau)
                place = output.stops()[side][()] if path is None else path
                gap = sign * (x - place)
                size = np.ptp(x)
                self.assertGreater(gap.min(), -1e-9 * size, (name, side))
                self.assertLess(gap.min() if (sides == -sign).any() else 0.0, 2e-3 * size, (name, side))
            lower, upper = (float(place[()]) for place in output.reach())
            self.assertTrue(lower < x.min() and x.max() <= upper * (1 + 1e-12), name)


if __name__ == "__main__":
    unittest.main()
