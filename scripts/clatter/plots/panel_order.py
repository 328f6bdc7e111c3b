"""Which results share a panel, which have none, and the order of the panels."""

BOOKKEEPING = (
    "status",
    "impact_total",
    "simulated_periods",
    "settling_estimate",
    "impact_count",
    "base_frequency",
    "energy_residual",
)
TOGETHER = (
    ("x_min", "x_max"),
    ("v_min", "v_max"),
    ("y_min", "y_max"),
    ("z_min", "z_max"),
    ("v_before", "v_after"),
    ("work_in", "loss_damping", "loss_friction"),
)  # results that share a panel
ORDER = (
    "x_min",
    "x_max",
    "v_min",
    "v_max",
    "y_min",
    "y_max",
    "z_min",
    "z_max",
    "symmetric",
    "period_ratio",
    "period",
    "eigenfrequency",
    "velocity_ratio",
    "impacts_per_period",
    "v_before",
    "v_after",
    "impact_speed",
    "rest_fraction",
    "stick_fraction",
    "settling_periods",
    "x_amplitude",
    "x_phase",
    "v_amplitude",
    "v_phase",
    "z_amplitude",
    "z_phase",
    "w_amplitude",
    "w_phase",
    "multiplier_re",
    "multiplier_im",
    "lyapunov",
    "work_in",
    "loss_damping",
    "loss_friction",
    "loss_impact",
    "impulse",
    "impact_power",
)


def in_order(names):
    """Names in the order of the panels; unknown ones come last."""
    return sorted(names, key=lambda name: ORDER.index(name) if name in ORDER else len(ORDER))
