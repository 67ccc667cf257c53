"""Adhesion of Gaussian surfaces by their summits' statistics alone: the theory that the model is
drawn beside.

Independent of the core: quadrature over summits of one radius with Gaussian heights (Greenwood and
Williamson, Proc. R.
Soc. A 295 (1966) 300), each a JKR sphere on a plane (Fuller and Tabor, Proc. R. Soc. A 345 (1975)
327; Gui et al., J.
Appl. Phys. 85 (1999) 7448 for area and bonding energy at zero load).

One sphere is written in Maugis' units: radius of contact (pi w R^2/K)^(1/3), approach its square
over R, load pi w R, energy pi w (radius of contact)^2; K = 4E/3. Heights are in units of the rms
height sigma of the composite surface, the adhesion parameter is theta = (E/w) sqrt(sigma^3/R) with
R the summits' mean radius.
"""

import functools
import math

from scipy import integrate, optimize

BIGGEST_HEIGHT = (
    12.0  # [sigma of the summits]: higher ones are left out; beyond it the density is below 1e-31
)


# ---------------------------------------------------------------- one sphere
def jkr_load(radius):
    """Load at a radius of contact; -3/2 at its smallest."""
    return radius**3 - math.sqrt(6 * radius**3)


def jkr_approach(radius):
    """Approach at a radius of contact, from where the undeformed sphere would touch."""
    return radius**2 - 2 / 3 * math.sqrt(6 * radius)


def jkr_approach_slope(radius):
    return 2 * radius - math.sqrt(6 / radius) / 3


def jkr_energy(radius):
    """Energy that coming to this radius of contact set free: surface energy less what is stored
    elastically."""
    return radius**2 - (radius**5 / 15 + jkr_load(radius) ** 2 / (3 * radius))


FIRST_RADIUS = (8 / 3) ** (1 / 3)  # approach 0: the sphere has just jumped into contact
UNLOADED_RADIUS = 6 ** (1 / 3)  # load 0
LAST_RADIUS = 6 ** (
    -1 / 3
)  # fixed grips: the approach has its minimum here, and the contact breaks


# ---------------------------------------------------------------- summits of a Gaussian surface
class SummitStatistics:
    """Of a surface with the autocorrelation sigma^2 exp(-r^2/l^2); lengths in units of sigma
    (heights) and l (lateral).

    radius: 1/mean curvature of the summits [l^2/sigma]; density [1/l^2]; rms: of the summits'
    heights [sigma].
    Nayak 1971 and McCool, Wear 107 (1986) 37 for density and curvature; Bush, Gibson, Keogh, Mech.
    Res. Comm. 3 (1976)
    169 for the heights.
    """

    def __init__(self):
        m0, m2, m4 = 1.0, 2.0, 12.0  # [sigma^2/l^n]
        nayak = m0 * m4 / m2**2
        self.density = m4 / (6 * math.pi * math.sqrt(3) * m2)
        self.radius = 1 / (8 / 3 * math.sqrt(m4 / math.pi))
        self.rms = math.sqrt(m0 * (1 - 0.8968 / nayak))


SUMMITS = SummitStatistics()


def unit_approach(theta):
    """Maugis' unit of approach [sigma] at an adhesion parameter."""
    return (0.75 * math.pi / theta) ** (2 / 3)


def normal_density(height):
    return math.exp(-0.5 * height * height) / math.sqrt(2 * math.pi)


def greenwood_williamson(exponent, separation, density=normal_density, highest=BIGGEST_HEIGHT):
    """Integral of (s - h)^n times the density of heights, from h = separation up; in units of the
    summits' rms."""
    value, _ = integrate.quad(
        lambda s: (s - separation) ** exponent * density(s),
        separation,
        max(highest, separation + highest),
        limit=200,
        epsabs=0,
    )
    return value


def pieces(lower, upper, rms, separation, unit):
    """Ends of the pieces between which the quadrature runs, so that it misses no peak and no piece
    has both signs: where the density of heights is largest and where it has fallen off, and where a
    sphere in contact carries nothing."""
    inner = [k * rms for k in (-6, -3, -1, 0, 1, 3, 6)] + [lower + k * rms for k in (0.1, 0.3, 1)]
    inner += [
        separation + unit * approach
        for approach in (jkr_approach(UNLOADED_RADIUS), UNLOADED_RADIUS**2 / 2)
    ]
    return sorted({lower, upper} | {height for height in inner if lower < height < upper})


def quadrature(function, ends):
    return sum(
        integrate.quad(function, a, b, limit=200, epsabs=0, epsrel=1e-9)[0]
        for a, b in zip(ends, ends[1:])
    )


def over_contacts(of_radius, separation, unit, smallest_radius, rms):
    """Integral of of_radius over the summits in contact, per summit. separation, unit, rms in one
    unit of height."""
    highest = max(separation + BIGGEST_HEIGHT * rms, (BIGGEST_HEIGHT + 1) * rms)
    lowest = separation + unit * jkr_approach(smallest_radius)
    lower = max(lowest, -BIGGEST_HEIGHT * rms)
    upper = min(highest, max(lower, 0.0) + BIGGEST_HEIGHT * rms)

    def radius_at(height):
        wanted = (height - separation) / unit
        if wanted <= jkr_approach(smallest_radius):
            return smallest_radius
        return optimize.brentq(
            lambda a: jkr_approach(a) - wanted,
            smallest_radius,
            3 + 2 * math.sqrt(abs(wanted)) + wanted,
        )

    def integrand(radius):
        height = separation + unit * jkr_approach(radius)
        return (
            of_radius(radius)
            * normal_density(height / rms)
            * unit
            / rms
            * jkr_approach_slope(radius)
        )

    return quadrature(
        integrand, [radius_at(height) for height in pieces(lower, upper, rms, separation, unit)]
    )


# ---------------------------------------------------------------- pull-off: Fuller and Tabor
def fuller_tabor(theta):
    """Largest tension over that of all summits at once, N (3/2) pi w R; theta with the rms of the
    *summits*."""
    unit = unit_approach(theta)

    def tension(separation):
        return -over_contacts(jkr_load, separation, unit, LAST_RADIUS, 1.0)

    # Under tension the plane is about where the summits' mean would pull: a few units or a few rms
    # around it.
    best = optimize.minimize_scalar(
        lambda d: -tension(d),
        bounds=(-3.0 * unit - 2.0, 3.0 * unit + 5.0),
        method="bounded",
        options={"xatol": 1e-7},
    )
    return -best.fun / 1.5


# ---------------------------------------------------------------- at rest under no load: Gui et al.
class Rest:
    """separation of the planes above the summits' mean [sigma]; share of summits in contact; area
    over nominal area; bonding energy over w times nominal area. Area and energy beyond 1 mean that
    contacts would overlap: the theory has ended."""

    def __init__(self, separation, share, area, energy):
        self.separation, self.share, self.area, self.energy = separation, share, area, energy


def _zero(balance):
    """The separation at which the balance, attraction far away and repulsion near, is zero."""
    low, high = -1.0, 1.0
    while balance(low) <= 0:
        low *= 2
    while balance(high) >= 0:
        high *= 1.3
    return optimize.brentq(balance, low, high, xtol=1e-10)


@functools.lru_cache(maxsize=None)
def rest_of_jkr_summits(theta):
    """Summits that have come into contact (approach > 0) and whose JKR loads balance."""
    unit = unit_approach(theta)

    def contacts(of_radius, separation):
        return over_contacts(of_radius, separation, unit, FIRST_RADIUS, SUMMITS.rms)

    separation = _zero(lambda d: contacts(jkr_load, d) / normal_density(max(d, 0.0) / SUMMITS.rms))
    area_unit = (
        math.pi * SUMMITS.density * SUMMITS.radius * unit
    )  # pi (radius of contact)^2 per nominal area
    return Rest(
        separation,
        contacts(lambda a: 1.0, separation),
        area_unit * contacts(lambda a: a * a, separation),
        area_unit * contacts(jkr_energy, separation),
    )


@functools.lru_cache(maxsize=None)
def rest_of_cap_summits(theta):
    """The same summits under the paper's approach: the undeformed sphere is cut, radius^2 = 2 x
    approach, and the energy has its extremum where the sum of r = -(P1 - 6)/3 (units of pi w R) is
    zero, P1 = radius^3."""
    unit = unit_approach(theta)

    def contacts(of_radius, separation):
        lower = max(separation, -BIGGEST_HEIGHT * SUMMITS.rms)
        upper = max(lower, 0.0) + BIGGEST_HEIGHT * SUMMITS.rms
        return quadrature(
            lambda z: (
                of_radius(math.sqrt(2 * (z - separation) / unit))
                * normal_density(z / SUMMITS.rms)
                / SUMMITS.rms
            ),
            pieces(lower, upper, SUMMITS.rms, separation, unit),
        )

    separation = _zero(
        lambda d: contacts(lambda a: a**3 - 6, d) / normal_density(max(d, 0.0) / SUMMITS.rms)
    )
    area_unit = math.pi * SUMMITS.density * SUMMITS.radius * unit
    return Rest(
        separation,
        contacts(lambda a: 1.0, separation),
        area_unit * contacts(lambda a: a * a, separation),
        area_unit * contacts(lambda a: a * a - a**5 / 15, separation),
    )
