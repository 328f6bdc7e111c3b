"""Random scenes of all effects together: runs of one motion that is written in two ways agree (combinations.py).

Environment: CLATTER, the program; CLATTER_COMBINATIONS, COUNT or COUNT:SEED of the random scenes, of which a tenth, but
at least some, go through branches and through followed sweeps and starts.
"""

import os
import unittest

from combinations import Campaign, report
from followed_branches import BranchCampaign
from followed_curves import CurveCampaign
from force_scenes import driven
from random_scenes import (
    bumping_scenes,
    carrying_scenes,
    followed_scenes,
    rough_scenes,
    rubbed_scenes,
    rubbing_scenes,
    slipping_scenes,
    weak_scenes,
)
from restitution_scenes import by_speed
from sweep_relations import SweepCampaign

CLATTER = os.environ["CLATTER"]
AT_ONCE = 250
COUNT, _, SEED = os.environ.get("CLATTER_COMBINATIONS", "30").partition(":")
COUNT, SEED = int(COUNT), int(SEED or 4116)


class Combinations(unittest.TestCase):
    maxDiff = None

    def check(self, scenes):
        campaign = Campaign(CLATTER, scenes)
        self.assertEqual(report(campaign.failures), "")
        self.assertGreater(campaign.decided.sum(), 0.9 * len(scenes))

    def test_two_ways_to_write_a_scene_give_one_motion(self):
        for first in range(0, COUNT, AT_ONCE):
            self.check(rough_scenes(min(AT_ONCE, COUNT - first), SEED + first // AT_ONCE))

    def test_two_ways_to_write_a_restitution_by_speed_give_one_motion(self):
        for first in range(0, COUNT // 3, AT_ONCE):
            count, seed = min(AT_ONCE, COUNT // 3 - first), SEED + 50 + first // AT_ONCE
            self.check(by_speed(rough_scenes(count, seed), seed, tables=0.15))

    def test_two_ways_to_write_a_scene_under_a_force_of_any_shape_give_one_motion(self):
        for first in range(0, COUNT // 2, AT_ONCE):
            count, seed = min(AT_ONCE, COUNT // 2 - first), SEED + 70 + first // AT_ONCE
            self.check(driven(rough_scenes(count, seed), seed))

    def test_every_impact_of_a_weak_scene_is_told(self):
        """Once spring, damper and force were next to nothing, chatter was summed from its first rebound on."""
        self.check(weak_scenes())

    def test_points_of_branches_are_motions_and_no_special_point_is_missing(self):
        campaign = BranchCampaign(CLATTER, followed_scenes(max(12, COUNT // 10), SEED))
        self.assertEqual(report(campaign.failures), "")
        self.assertGreater(campaign.points, 100)

    def test_points_of_branches_with_a_restitution_by_speed_are_motions(self):
        scenes = followed_scenes(max(10, COUNT // 20), SEED + 3) + bumping_scenes(max(6, COUNT // 20), SEED + 3)
        campaign = BranchCampaign(CLATTER, by_speed(scenes, SEED, tables=0))  # each point would be a run of its own
        self.assertEqual(report(campaign.failures), "")
        self.assertGreater(campaign.points, 60)

    def test_points_of_branches_under_dry_friction_are_motions(self):
        campaign = BranchCampaign(CLATTER, slipping_scenes(max(16, COUNT // 10), SEED))
        self.assertEqual(report(campaign.failures), "")
        self.assertGreater(campaign.points, 150)

    def test_points_of_branches_under_dry_friction_between_soft_stops_are_motions(self):
        campaign = BranchCampaign(CLATTER, rubbing_scenes(max(16, COUNT // 10), SEED))
        self.assertEqual(report(campaign.failures), "")
        self.assertGreater(campaign.points, 150)

    def test_branches_under_dry_friction_have_the_special_points_of_curves(self):
        for scenes in (slipping_scenes, rubbing_scenes):
            campaign = CurveCampaign(CLATTER, scenes(max(10, COUNT // 20), SEED))
            self.assertEqual(report(campaign.failures), "")
            self.assertGreater(campaign.crossings, 2)
            self.assertLess(campaign.unmet, campaign.crossings / 4)

    def test_points_of_branches_with_a_loose_mass_are_motions(self):
        campaign = BranchCampaign(CLATTER, carrying_scenes(max(15, COUNT // 10), SEED))
        self.assertEqual(report(campaign.failures), "")
        self.assertGreater(campaign.points, 60)

    def test_points_of_branches_with_a_loose_mass_beside_stops_are_motions(self):
        campaign = BranchCampaign(CLATTER, bumping_scenes(max(40, COUNT // 5), SEED))
        self.assertEqual(report(campaign.failures), "")
        self.assertGreater(campaign.points, 50)

    def test_points_of_a_sweep_know_where_the_others_end(self):
        """Followed points begin there, and starts are numbered by it."""
        self.check_sweeps(followed_scenes(max(16, COUNT // 10), SEED + 1), 150)

    def test_points_of_a_sweep_under_dry_friction_know_it_too(self):
        count = max(12, COUNT // 10)
        rubbed = [s for s in rubbed_scenes(2 * count, SEED + 2) if not s.is_unforced() and s.stiffness > 0]
        self.check_sweeps(slipping_scenes(count, SEED + 2) + rubbed, 300)

    def check_sweeps(self, scenes, least):
        campaign = SweepCampaign(CLATTER, scenes)
        self.assertEqual(report(campaign.failures), "")
        self.assertGreater(campaign.points, least)


if __name__ == "__main__":
    unittest.main()
