"""Outputs over another of their keys: one that is linked to an axis, or all points over one key."""

import copy
import dataclasses


def swept_keys(output):
    """The keys of the scene that have values along an axis, their own or that of another key."""
    keys = [key for key in output.sweep if key in output and key != "direction"]
    return [key for key in keys if len(output[key].dims) == 1 and output[key].dims[0] in output.axes]


def led_by(output, key):
    """This output with the axis that a key is linked to named by that key; itself if there is none."""
    if key in output.axes or key not in swept_keys(output):
        return output
    axis, part = output[key].dims[0], copy.copy(output)
    part.axes = tuple(key if name == axis else name for name in output.axes)
    part.variables = {
        name: dataclasses.replace(variable, dims=tuple(key if dim == axis else dim for dim in variable.dims))
        for name, variable in output.variables.items()
    }
    return part


def scattered(output, key):
    """All points of this output along one axis, at their values of a key."""
    part, axes = copy.copy(output), output.axes
    part.axes, part.is_scattered, part.variables = (key,), True, {}
    for name, variable in output.variables.items():
        if name in swept_keys(output):
            values = output.parameter(name).ravel()
            part.variables[name] = dataclasses.replace(variable, values=values, dims=(key,))
        elif variable.dims[: len(axes)] == axes:
            values = variable.values.reshape(-1, *variable.values.shape[len(axes) :])
            part.variables[name] = dataclasses.replace(variable, values=values, dims=(key, *variable.dims[len(axes) :]))
        elif not set(variable.dims) & set(axes):
            part.variables[name] = variable
    return part
