"""The shot that most likely pots a ball, for somebody who shoots badly, and how badly one may.

    python examples/plan_under_noise.py --noise fastfiz

Three balls lie on a seven-foot table. The oracle looks for the stroke with the best chance to pot
ball 1 and to keep the cue ball on the cloth; then it says how large each error alone may be.
"""

import argparse
import dataclasses
import time

from pool_sim_ros.oracle import Goal, error_budget, find_shots
from pool_sim_ros.physics import pool_table


def three_balls():
    """Return the table with the cue ball, ball 1 near a corner, and ball 2 in the way."""
    table = pool_table('7ft')
    places = {'C': (1.4, 0.5), '1': (0.35, 0.25), '2': (0.9, 0.4)}
    balls = [table.balls[table.index(label)] for label in places]
    balls = [dataclasses.replace(ball, position=places[ball.label]) for ball in balls]
    return dataclasses.replace(table, balls=balls)


def main():
    """Search, print the plan, and what an error costs."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--noise', choices=('fastfiz', 'sjtu'), default='fastfiz')
    parser.add_argument('--shots', type=int, default=330_000, help='that the search may play')
    given = parser.parse_args()
    table = three_balls()
    goal = Goal(ball='1', pocket='any') & Goal(keep='C')
    begin = time.perf_counter()
    plan = find_shots(table, goal, given.noise, shots=given.shots, seed=1)
    print(plan)
    print(f'{time.perf_counter() - begin:.2f} s, the first time with compiling\n')
    if plan:
        print('The chance of the best as one error grows alone:')
        print(error_budget(table, goal, plan[0], shots=max(given.shots // 100, 100)))


if __name__ == '__main__':
    main()
