"""Whether a series drifts: an average of the newest values, and rules on runs, beside the control
limits. No ROS here.

The first values are the baseline: their centre and scatter (control_chart) judge those that follow,
so that a drift does not widen its own limits.

The average is the EWMA (Roberts 1959; Montgomery, Introduction to Statistical Quality Control,
section 9.2) z = 0.2 x + 0.8 z, which finds slow changes that no single value shows. Its limits,
2.86 sigma of z, would be crossed by chance once in 370 values if centre and sigma were known; so
would those of single values, at 3 sigma. They are from the baseline: so the centre's own variance
is added, and 2.86 and 3 become quantiles of Student's t with the degrees of freedom of a mean
moving range.

The rules on runs are those of Western Electric (1956) and Nelson (J. Quality Technology 16 (1984)
237). All of them together call most series of a hundred values that do not change; so they are
signs, and only the average and the single value raise an alarm unless told otherwise.
"""

import math

from mems_stiction.control_chart import FEWEST, control_limits

BASELINE = 20  # values
WEIGHT = 0.2
REACH = 2.86  # sigmas of the average: one false alarm in 370 values (Lucas and Saccucci 1990)
SINGLE = 3.0  # of one value
FREEDOM = 0.62  # degrees of freedom that the mean moving range has for each value but one
LEAST_SIGMA = 1e-9  # of logarithms: below is round-off
LONGEST = 9  # values that a rule looks at

RULES = {
    "average": "the average of the newest scans is beyond its limits",
    "outside": "the scan is beyond the control limits",
    "two_of_three": "2 of 3 scans beyond 2 sigma on one side",
    "four_of_five": "4 of 5 scans beyond 1 sigma on one side",
    "nine_on_one_side": "9 scans in a row on one side of the centre",
    "six_in_a_row": "6 scans in a row that rise or fall",
}
ALARMS = ("average", "outside")


class DriftState:
    """What the newest value says. Limits are NaN while the baseline grows.

    count: values so far; broken: names of rules, those of RULES; is_alarm: one of those that raise
    it is among them; rises: on which side.
    """

    def __init__(self, value, count, baseline):
        self.value, self.count, self.baseline = value, count, baseline
        self.centre = self.lower = self.upper = self.average = self.average_lower = (
            self.average_upper
        ) = math.nan
        self.broken = ()
        self.is_alarm = self.rises = False

    def words(self, what):
        """One sentence; what: the figure that is watched."""
        if math.isnan(self.centre):
            return "baseline of %s: %d of %d scans" % (what, self.count, self.baseline)
        signs = "; ".join(RULES[name] for name in self.broken)
        if not self.is_alarm:
            return "no drift of %s in %d scans%s" % (
                what,
                self.count,
                ", but a sign: " + signs if signs else "",
            )
        return "%s is %s: %s" % (what, "high" if self.rises else "low", signs)


class DriftChart:
    """Takes values in the order in which they were measured."""

    def __init__(self, baseline=BASELINE, alarms=ALARMS):
        if baseline < FEWEST:
            raise ValueError("baseline: %d is not allowed, must be >= %d" % (baseline, FEWEST))
        self._size, self._alarms = baseline, tuple(alarms)
        self._baseline, self._newest = [], []
        self._count = self._watched = 0
        self._limits = None
        self._sigma = self._average = self._reach = self._reach_of_one = math.nan

    def begun(self):
        """The state before the first value."""
        return DriftState(math.nan, 0, self._size)

    def add(self, value):
        """The state after this value, which is > 0 and finite; None for another, which is passed
        over."""
        if not 0.0 < value < math.inf:
            return None
        self._count += 1
        state = DriftState(value, self._count, self._size)
        if self._limits is None:
            self._baseline.append(value)
            if len(self._baseline) == self._size:
                self._settle()
            return state
        self._judge(math.log(value), state)
        return state

    def _settle(self):
        from scipy.stats import norm, t

        self._limits = control_limits(self._baseline)
        self._average = math.log(self._limits.centre)
        self._sigma = max(math.log(self._limits.upper / self._limits.centre) / 3.0, LEAST_SIGMA)
        self._reach, self._reach_of_one = (
            float(t.isf(norm.sf(reach), FREEDOM * (self._size - 1))) for reach in (REACH, SINGLE)
        )

    def _judge(self, value, state):
        centre = math.log(self._limits.centre)
        self._watched += 1
        self._average += WEIGHT * (value - self._average)
        memory = (1.0 - WEIGHT) ** self._watched
        share = WEIGHT / (2.0 - WEIGHT) * (1.0 - memory**2) + (1.0 - memory) ** 2 / self._size
        reach = self._reach * self._sigma * math.sqrt(share)
        single = self._reach_of_one * self._sigma * math.sqrt(1.0 + 1.0 / self._size)
        self._newest = (self._newest + [(value - centre) / self._sigma])[-LONGEST:]
        state.centre, state.lower, state.upper = (
            self._limits.centre,
            math.exp(centre - single),
            math.exp(centre + single),
        )
        state.average, state.average_lower, state.average_upper = (
            math.exp(end) for end in (self._average, centre - reach, centre + reach)
        )
        sides = {
            name: side
            for name, side in self._sides(
                self._average - centre, reach, single / self._sigma
            ).items()
            if side
        }
        state.broken = tuple(name for name in RULES if name in sides)
        raised = [name for name in state.broken if name in self._alarms]
        state.is_alarm = bool(raised)
        state.rises = bool(raised) and sides[raised[0]] > 0

    def _sides(self, off, reach, single):
        """Of each rule: 1 broken above, -1 below, 0 not broken."""
        newest = self._newest
        rising = all(after > before for before, after in zip(newest[-6:], newest[-5:]))
        falling = all(after < before for before, after in zip(newest[-6:], newest[-5:]))
        return {
            "average": (off > reach) - (off < -reach),
            "outside": (newest[-1] > single) - (newest[-1] < -single),
            "two_of_three": _side(newest[-3:], 2.0, 2),
            "four_of_five": _side(newest[-5:], 1.0, 4),
            "nine_on_one_side": _side(newest, 0.0, LONGEST),
            "six_in_a_row": (rising - falling) if len(newest) >= 6 else 0,
        }


def _side(values, beyond, count):
    """On which side so many are, the newest among them."""
    above, below = (
        sum(sign * value > beyond for value in values) >= count and sign * values[-1] > beyond
        for sign in (1.0, -1.0)
    )
    return above - below
