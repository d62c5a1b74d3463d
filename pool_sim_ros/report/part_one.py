"""An example of the report's Part 1: two balls that meet at an offset."""

from __future__ import annotations

import math
from dataclasses import dataclass

from pool_sim_ros.physics import Ball, DiscFriction, Table, TwoBallCollision, two_ball_collision

VELOCITY = (1.2, 0.6)
"""Of ball a, m/s; ball b is at rest."""

OFFSET = 0.4
"""As a part of the sum of the radii, to the left of a's motion."""


@dataclass(frozen=True, eq=False)
class Example:
    """A collision to draw and to compute: the moving ball a hits ball b, which rests.

    Attributes
    ----------
    a, b : Ball
        Only their masses and radii are used.
    velocity : tuple of float
        Of a, m/s.
    offset : float
        The report's e, m.
    restitution, friction : float
        Coefficients.
    """

    a: Ball
    b: Ball
    velocity: tuple[float, float]
    offset: float
    restitution: float
    friction: float

    @property
    def reach(self) -> float:
        """Distance of the centres at impact, the report's h, m."""
        return self.a.radius + self.b.radius

    @property
    def velocity_angle(self) -> float:
        """Direction of a's motion, rad from the y axis towards x (report, Equation 4)."""
        return math.atan2(*self.velocity)

    @property
    def offset_angle(self) -> float:
        """Angle between a's motion and the line of centres, rad (report, Equation 4)."""
        return math.asin(self.offset / self.reach)

    @property
    def impact_angle(self) -> float:
        """Direction of the line of centres, rad from the y axis towards x (Equation 4)."""
        return self.velocity_angle - self.offset_angle

    def collide(self, ball_friction: DiscFriction) -> TwoBallCollision:
        """Return the outcome under a law of friction.

        Parameters
        ----------
        ball_friction : {'report', 'coulomb'}

        Returns
        -------
        TwoBallCollision
        """
        return two_ball_collision(
            self.a.mass,
            self.b.mass,
            self.velocity,
            (0.0, 0.0),
            self.a.radius,
            self.b.radius,
            self.offset,
            self.restitution,
            self.friction,
            ball_friction,
        )


def example(table: Table) -> Example:
    """Return the example with the first two balls and the coefficients of a table."""
    a, b = table.balls[0], table.balls[min(1, len(table.balls) - 1)]
    restitution = table.e_cue_ball if a.is_cue or b.is_cue else table.e_ball_ball
    offset = OFFSET * (a.radius + b.radius)
    return Example(a, b, VELOCITY, offset, restitution, table.mu_ball_ball)
