"""Control limits of a series: which scans differ from the others by more than their usual scatter.

The chart of individual values (Shewhart 1931; Montgomery, Introduction to Statistical Quality
Control, section 6.4; ISO 7870-2): the centre is the mean of the values, the limits lie 3 sigma to
both sides, and sigma is the mean moving range of neighbours over d2 = 1.128:

    limits = mean +- 2.66 x mean |x_i - x_(i-1)|        2.66 = 3/1.128

Forces spread by factors, so x is the logarithm of the force; the limits are then factors too. The
limits follow from the series that they judge: a drift widens them, and with few values they are
themselves uncertain (by a fifth with 20 values), so there are none below 8.
"""

import math
import sys

FACTOR = (
    3.0 / 1.128
)  # 3 sigma over d2, the mean range of two values of a normal distribution in sigmas
ROUND_OFF = 1e-12  # of logarithm and exponential, with room
LARGEST = math.log(sys.float_info.max)  # logarithm of a limit that is a number
FEWEST = 8  # values: below, the moving range is known to a third at best


class ControlLimits:
    """centre, lower and upper in the unit of the values."""

    def __init__(self, centre, lower, upper):
        self.centre, self.lower, self.upper = centre, lower, upper

    def is_outside(self, value):
        """Whether the value is positive, finite and beyond a limit by more than round-off, which is
        all that scatters where every value is the same."""
        return 0.0 < value < math.inf and not self.lower * (
            1 - ROUND_OFF
        ) <= value <= self.upper * (1 + ROUND_OFF)


def of_newest_settings(series):
    """Of (number, value, settings) in the order in which they were measured those with the settings
    of the last, as (number, value): other settings are another series."""
    return [(number, value) for number, value, settings in series if settings == series[-1][2]]


def control_limits(values):
    """Of values in the order in which they were measured; None where fewer than 8 are positive and
    finite. Values that are missing (NaN) leave a
    gap: the values on both its sides are neighbours."""
    logarithms = [
        math.log(value) for value in values if value is not None and 0.0 < value < math.inf
    ]
    if len(logarithms) < FEWEST:
        return None
    ranges = [abs(after - before) for before, after in zip(logarithms, logarithms[1:])]
    mean = sum(logarithms) / len(logarithms)
    reach = FACTOR * sum(ranges) / len(ranges)
    return ControlLimits(
        *(math.exp(min(logarithm, LARGEST)) for logarithm in (mean, mean - reach, mean + reach))
    )
