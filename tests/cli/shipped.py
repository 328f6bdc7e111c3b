"""The configurations in configs/, and coarser settings of those that take long."""

from command_line import SOURCE

COARSER = {  # settings of the shipped configurations that take long
    "basins": ("sweep.x0=linspace(-3, 3, 13)", "sweep.v0=linspace(-6, 6, 11)"),
    "ceiling": ("sweep.stop_upper=linspace(5 mm, 30 mm, 41)",),
    "energy_sink_basin": ("sweep.loose_x0=linspace(-1, 1, 11)", "sweep.loose_v0=linspace(-1, 1, 11)"),
    "map_nu_xs": ("sweep.nu=linspace(0.5, 1.5, 31)", "sweep.xs=linspace(2, 12, 21)"),
    "optimal_zones": ("sweep.nu=linspace(1, 13, 13)", "sweep.x0=sobol(-0.5, 0.5, 32)", "sweep.v0=sobol(-5, 5, 32)"),
    "regimes": ("sweep.nu=linspace(0.3, 1.3, 23)", "sweep.xs=linspace(0.05, 2.05, 9)"),
    "zones": ("sweep.nu=linspace(0.5, 1.5, 21)", "sweep.x0=sobol(-3, 3, 32)", "sweep.v0=sobol(-6, 6, 32)"),
}


def shipped():
    """Path, command of clatter, and settings of every configuration in configs/."""
    for config in sorted((SOURCE / "configs").glob("*.*")):
        if config.suffix in (".toml", ".ini"):
            command = "branch" if "[branch]" in config.read_text(encoding="utf-8") else "run"
            yield config, command, COARSER.get(config.stem, ())
