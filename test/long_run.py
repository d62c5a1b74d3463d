"""Play very many random shots on the report's table and check every one, under both laws.

Every shot: it ends, with finite positions, no ball in another or outside by more than 1e-9 m, and
not with absurdly many events. One in so many is looked at whole: no overlap at or between its
events, no rise of energy under `coulomb`, and the same bits from simulate() and simulate_many().
"""

from __future__ import annotations

import argparse
import math
import os
import sys
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from concurrent.futures import TimeoutError as StillRunning
from dataclasses import dataclass, replace
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE), str(HERE / 'support')]

import numpy as np  # noqa: E402
from tables import LAWS, kinetic_energy, worst_overlap  # noqa: E402

from pool_sim_ros.physics import Table, report_table, simulate, simulate_many  # noqa: E402
from pool_sim_ros.physics.cores import available_cores  # noqa: E402

ALLOWED = 1e-9 * (1 + 1e-6)
"""How deep a ball may be in another or in a cushion, m."""

V_MIN = 1e-4
"""What the rule for sustained contact may give both sides of a contact, m/s."""

MOST_EVENTS = 5000
SLOWEST, FASTEST = 0.1, 10.0  # m/s
CHUNK = 4000
ENDLESS, ENDLESS_SHOT = 120.0, 10.0
"""s after which a chunk, of some hundredths of a second, or a shot counts as endless."""

MOST_FAILURES_SHOWN = 20


@dataclass
class Chunk:
    """Shots of one law, from number `first` on, and what became of them."""

    table: Table
    first: int
    velocities: np.ndarray
    events: int = 0
    most_events: int = 0
    failures: tuple[str, ...] = ()

    def play(self, every: int) -> Chunk:
        """Play and check all shots, and one in `every` of them whole."""
        finals, durations, counts = simulate_many(self.table, self.velocities)[:3]
        self.events, self.most_events = int(counts.sum()), int(counts.max())
        faults = dict(self._faults_at_the_end(finals, durations, counts))
        for k in range(-self.first % every, len(finals), every):
            fault = fault_on_the_way(self.table, self.velocities[k], finals[k])
            if fault:
                faults.setdefault(k, fault)
        self.failures = tuple(f'{self.name(k)}: {fault}' for k, fault in faults.items())
        return self

    def _faults_at_the_end(self, finals, durations, counts) -> Iterator[tuple[int, str]]:
        finite = np.isfinite(finals).all(axis=(1, 2)) & np.isfinite(durations)
        if finite.all() and counts.max() <= MOST_EVENTS:
            if worst_overlap(self.table, finals) <= ALLOWED:
                return
        for k, positions in enumerate(finals):
            depth = worst_overlap(self.table, positions[None])
            if not finite[k]:
                yield k, 'a final position or the duration is not finite'
            elif counts[k] > MOST_EVENTS:
                yield k, f'{counts[k]} events, more than {MOST_EVENTS}'
            elif depth > ALLOWED:
                yield k, f'at the end a ball is {depth:.3g} m deep in another or in a cushion'

    def name(self, k: int) -> str:
        x, y = self.velocities[k]
        law = self.table.ball_friction
        return f'shot {self.first + k}, {law}, velocity ({float(x)!r}, {float(y)!r}) m/s'


def fault_on_the_way(table: Table, velocity: np.ndarray, final: np.ndarray) -> str:
    """Look at a whole shot, which ends at `final`; return what is wrong, or ''."""
    shot = simulate(table, velocity)
    if shot.final_positions.tobytes() != final.tobytes():
        return 'simulate() ends elsewhere than simulate_many()'
    instants = np.unique(np.concatenate([[0.0], shot.events['t']]))
    times = np.concatenate([instants, (instants[1:] + instants[:-1]) / 2])
    depth = worst_overlap(table, shot.positions(times))
    if not depth <= ALLOWED:
        return f'on the way a ball is {depth:.3g} m deep in another or in a cushion'
    if table.ball_friction == 'coulomb':
        gain = energy_gained(table, velocity, shot, instants)
        if not gain <= 0.0:
            return f'energy rises by {gain:.3g} J'
    return ''


def energy_gained(table: Table, velocity: np.ndarray, shot, instants: np.ndarray) -> float:
    """Return the greatest rise of energy (J) beyond what V_MIN and rounding can add."""
    start = np.zeros((len(table.balls), 2))
    start[0] = velocity
    energy = kinetic_energy(table, np.concatenate([start[None], shot.velocities(instants)]))
    # k contacts of one instant that part at V_MIN leave a ball at most k V_MIN.
    times = shot.events['t']
    contacts = np.searchsorted(times, instants, 'right') - np.searchsorted(times, instants, 'left')
    slack = 1e-12 * energy[0] + 0.5 * table.masses.sum() * (contacts * V_MIN) ** 2
    return float(np.max(np.diff(energy) - slack))


def chunks(shots: int, seed: int) -> Iterator[Chunk]:
    """Yield the shots of both laws, the same velocities for each."""
    rng = np.random.default_rng(seed)
    for first in range(0, shots, CHUNK):
        count = min(CHUNK, shots - first)
        speed = rng.uniform(SLOWEST, FASTEST, count)
        angle = rng.uniform(-math.pi, math.pi, count)
        velocities = np.stack([speed * np.cos(angle), speed * np.sin(angle)], axis=1)
        for law in LAWS:
            yield Chunk(replace(report_table(), ball_friction=law), first, velocities)


def first_endless(chunk: Chunk) -> str:
    """Return the name of the shot that takes longer than `ENDLESS_SHOT`, by playing each alone."""
    for k in range(len(chunk.velocities)):
        one = chunk.velocities[k : k + 1]
        runner = threading.Thread(target=simulate_many, args=(chunk.table, one), daemon=True)
        runner.start()
        runner.join(ENDLESS_SHOT)
        if runner.is_alive():
            return chunk.name(k)
    return f'{chunk.name(0)}, or one of the {len(chunk.velocities) - 1} after it'


def played(shots: int, seed: int, every: int) -> Iterator[Chunk]:
    """Yield the chunks in order, played on every core; leave with status 1 if one has no end."""
    next(chunks(1, seed)).play(1)  # compiles what the threads need
    pool = ThreadPoolExecutor(available_cores())
    try:
        waiting = [(chunk, pool.submit(chunk.play, every)) for chunk in chunks(shots, seed)]
        for chunk, answer in waiting:
            try:
                yield answer.result(ENDLESS)
            except StillRunning:
                print(f'\n{first_endless(chunk)}: it does not end', file=sys.stderr, flush=True)
                os._exit(1)  # the thread that plays it cannot be stopped
    finally:
        pool.shutdown(cancel_futures=True)


def run(shots: int, seed: int, every: int) -> bool:
    """Play all shots, with a progress bar; return whether all passed."""
    from tqdm import tqdm

    start, failed, events, most = time.monotonic(), 0, 0, 0
    with tqdm(total=len(LAWS) * shots, unit=' shots', unit_scale=True, disable=None) as bar:
        for chunk in played(shots, seed, every):
            for failure in chunk.failures[: max(MOST_FAILURES_SHOWN - failed, 0)]:
                bar.write(failure, file=sys.stderr)
            failed += len(chunk.failures)
            events, most = events + chunk.events, max(most, chunk.most_events)
            bar.update(len(chunk.velocities))
    print(
        f'{shots} shots under each law, seed {seed}, one in {every} looked at whole: '
        f'{failed} failed; {events / (len(LAWS) * shots):.1f} events a shot, at most {most}; '
        f'{time.monotonic() - start:.0f} s'
    )
    return failed == 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition('\n\n')[0])
    parser.add_argument('--shots', type=positive, default=1_000_000, help='default: 1000000')
    parser.add_argument('--seed', type=int, default=1, help='of the random velocities; default: 1')
    parser.add_argument(
        '--every', type=positive, default=100, help='look at one in so many whole; default: 100'
    )
    arguments = parser.parse_args()
    try:
        return 0 if run(arguments.shots, arguments.seed, arguments.every) else 1
    except ModuleNotFoundError as error:
        print(f"{error.name} is missing: pip install '.[bench]'", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print('stopped before the end', file=sys.stderr)
        return 130


def positive(text: str) -> int:
    """Return a whole number above zero."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f'{text!r} must be a whole number, 1 or more')
    return int(text)


if __name__ == '__main__':
    sys.exit(main())
