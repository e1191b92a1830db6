# SPDX-License-Identifier: Apache-2.0
"""A plane's grid of triangles as every document of the exporters has it, and what is right of it."""

import random
from dataclasses import dataclass, field

METRES = {"meter": 1.0, "foot": 0.3048, "USSurveyFoot": 1200.0 / 3937.0, "millimeter": 1e-3, "centimeter": 1e-2}


@dataclass
class Ground:
    """Heights of a plane over nx times ny points, m; `hidden` faces are no ground."""
    east: float
    north: float
    height: float
    rise_east: float
    rise_north: float
    step: float
    nx: int
    ny: int
    first_id: int = 1
    id_step: int = 1
    hidden: int = 0
    noise: random.Random = field(default_factory=lambda: random.Random(0))

    def height_at(self, x, y):
        return self.height + self.rise_east * (x - self.east) + self.rise_north * (y - self.north)

    def points(self):
        """Id, east, north, height."""
        for row in range(self.ny):
            for column in range(self.nx):
                x, y = self.east + column * self.step, self.north + row * self.step
                yield self.first_id + self.id_step * (row * self.nx + column), x, y, self.height_at(x, y)

    def faces(self):
        """Three ids, and whether it is ground."""
        at = lambda row, column: self.first_id + self.id_step * (row * self.nx + column)
        count = 0
        for row in range(self.ny - 1):
            for column in range(self.nx - 1):
                a, b, c, d = at(row, column), at(row, column + 1), at(row + 1, column), at(row + 1, column + 1)
                for face in ((a, b, d), (a, d, c)):
                    yield face, count >= self.hidden
                    count += 1

    def area(self):
        return 0.5 * self.step ** 2 * (2 * (self.nx - 1) * (self.ny - 1) - self.hidden)


def drawn(noise):
    """On a national grid, a site's grid, or west of its origin."""
    east, north = noise.choice(((452310.25, 5411220.5), (1000.0, 5000.0), (-740.5, -312.0), (2.1e6, 6.9e5)))
    return Ground(east, north, noise.choice((-3.2, 54.3, 1312.75)), noise.uniform(-0.3, 0.3), noise.uniform(-0.3, 0.3),
                  noise.choice((0.5, 5.0, 20.0)), noise.randint(2, 5), noise.randint(2, 4),
                  noise=noise)
