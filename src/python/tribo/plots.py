# SPDX-License-Identifier: MIT
"""Pictures with matplotlib, which is imported only here."""

import numpy as np

_vector, _tensor = ("x", "y", "z"), ("xx", "yy", "zz", "xy", "yz", "xz")


def _pyplot():
    try:
        import matplotlib.pyplot as plt
    except ModuleNotFoundError:
        raise ModuleNotFoundError("pictures need matplotlib: install Debian's package python3-matplotlib (apt install "
                                  "python3-matplotlib), or matplotlib with pip", name="matplotlib") from None
    return plt


def _axes(ax):
    plt = _pyplot()
    return ax if ax is not None else plt.subplots()[1]


def _axes_in_space(ax):
    plt = _pyplot()
    return ax if ax is not None else plt.figure().add_subplot(projection="3d")


def _unit(unit):
    return f" [{unit}]" if unit and unit != "-" else ""


def plot_table(table, x, y, ax):
    """Columns of a table over another one."""
    ax = _axes(ax)
    numbers = [name for name in table if table[name].dtype != object]
    x = x or numbers[0]
    names = [y] if isinstance(y, str) else y or [name for name in numbers if name != x]
    for name in names:
        ax.plot(table[x], table[name], label=name)
    units = [_unit(table.units.get(name)) for name in names]
    ax.set_xlabel(x + _unit(table.units.get(x)))
    ax.set_ylabel(names[0] + units[0] if len(names) == 1 else units[0].strip() if len(set(units)) == 1 else "")
    if len(names) > 1:
        ax.legend()
    return ax


def scalar(values, name, component):
    """One number per particle, and its name: a component or the magnitude of a vector or tensor."""
    if values.ndim == 1:
        return values, name
    words = _vector if values.shape[1] == 3 else _tensor
    if component is None:
        if len(words) != values.shape[1] or words is _tensor:
            raise ValueError(f"'{name}' is a tensor; name a component: {', '.join(_tensor)}")
        return np.linalg.norm(values, axis=1), f"|{name}|"
    if component not in words[: values.shape[1]]:
        raise ValueError(f"'{name}' has no component '{component}'; valid: {', '.join(words)}")
    return values[:, words.index(component)], f"{name}.{component}"


def plot_particles(frame, field, component, limits, ax, units):
    """The particles of a frame as their domains in two dimensions, as points in three."""
    values, label = scalar(frame[field], field, component)
    label += _unit(units.get(field))
    position, domain = frame["position"], frame.particles.get("domain")
    flat = domain is not None and domain.shape[1] == 4
    if flat:
        ax = _axes(ax)
        a, b, c = domain[:, :2], domain[:, 2:], position[:, :2]
        corners = np.stack([c - a - b, c + a - b, c + a + b, c - a + b], axis=1)
        drawn = _add_polygons(ax, corners, values, "face")
    else:
        ax = _axes_in_space(ax)
        drawn = ax.scatter(*position.T, c=values, s=4)
    _label(ax, drawn, flat, limits, label, frame, units)
    return ax


def plot_blocks(frame, field, component, limits, ax, units):
    """The blocks of a frame as polygons, in space as their faces."""
    values, label = scalar(frame[field], field, component)
    label += _unit(units.get(field))
    order, ends = frame["connectivity"], frame["offsets"]
    corners = [frame["position"][part] for part in np.split(order, ends[:-1])]
    flat = bool((frame["position"][:, 2] == 0).all())
    if flat:
        ax = _axes(ax)
        drawn = _add_polygons(ax, [part[:, :2] for part in corners], values, "black")
    else:
        ax = _axes_in_space(ax)
        from mpl_toolkits.mplot3d.art3d import Poly3DCollection

        drawn = Poly3DCollection(corners, array=values, edgecolors="black", linewidths=0.3)
        ax.add_collection3d(drawn)
        ax.auto_scale_xyz(*frame["position"].T)
    _label(ax, drawn, flat, limits, label, frame, units)
    return ax


def _add_polygons(ax, corners, values, edges):
    from matplotlib.collections import PolyCollection

    drawn = PolyCollection(corners, array=values, edgecolors=edges, linewidths=0.2)
    ax.add_collection(drawn)
    ax.autoscale_view()
    ax.set_aspect("equal")
    return drawn


def _label(ax, drawn, flat, limits, label, frame, units):
    """The scale of the colours, and the time above the picture."""
    if limits is not None:
        drawn.set_clim(*limits)
    if flat:  # as high as the picture, which may be a narrow strip
        bar = ax.inset_axes([1.03, 0, 0.03, 1])
        ax.figure.colorbar(drawn, cax=bar, label=label)
    else:
        ax.figure.colorbar(drawn, ax=ax, label=label)
    ax.set_title(f"time {frame.time:.4g}" + (f" {units['time']}" if units.get("time") else ""))


def plot_sweep(table, x, y, ax):
    """A column of a sweep over a parameter, a line for each value of the others."""
    ax = _axes(ax)
    x = x or table.parameters[0]
    hidden = {*table.parameters, "folder", "outcome", "time"}
    y = y or next(name for name in table if name not in hidden)
    others = [name for name in table.parameters if name != x]
    keys = list(zip(*(table[name] for name in others))) or [()] * table.rows
    for key in dict.fromkeys(keys):
        chosen = [k for k in range(table.rows) if keys[k] == key]
        label = ", ".join(f"{name} = {value:g}" if not isinstance(value, str) else f"{name} = {value}"
                          for name, value in zip(others, key))
        ax.plot(table[x][chosen], table[y][chosen], "o-", label=label or None)
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    if others:
        ax.legend()
    return ax
