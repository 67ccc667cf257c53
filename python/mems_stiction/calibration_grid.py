"""Values on a grid of two constants, and between: monotone cubics along each of them, in a form
that takes microseconds to ask."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import NdPPoly, PchipInterpolator


def between_nodes(x: np.ndarray, y: np.ndarray, values: np.ndarray) -> NdPPoly:
    """A function of rows of x, y that has these values at the nodes, and is continuous with its
    slopes.

    values: over x, y, and whatever hangs on them. Along y, values and slopes in x are PCHIP
    (Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984)
    300) of those at the nodes; along x, the cubic of Hermite is laid between them.
    """
    slopes = PchipInterpolator(x, values, axis=0).derivative()(x)
    of_values, of_slopes = (
        PchipInterpolator(y, at_nodes, axis=1).c for at_nodes in (values, slopes)
    )  # power of y, piece of y, node of x, ...
    step = np.diff(x).reshape((-1,) + (1,) * (values.ndim - 2))
    rise = np.diff(of_values, axis=2) / step
    first, second = of_slopes[:, :, :-1], of_slopes[:, :, 1:]
    by_powers = np.stack(
        [
            (first + second - 2.0 * rise) / step**2,
            (3.0 * rise - 2.0 * first - second) / step,
            first,
            of_values[:, :, :-1],
        ]
    )
    return NdPPoly(np.moveaxis(by_powers, 2, 3), (x, y))
