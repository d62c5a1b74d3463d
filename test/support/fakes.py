"""Stand-ins that need neither physics nor ROS."""

import numpy as np

EVENT = np.dtype(
    [
        (name, 'i8' if name in ('kind', 'a', 'b') else 'f8')
        for name in ('t', 'kind', 'a', 'b', 'x', 'y', 'nx', 'ny', 'speed')
    ]
)


class Glide:
    """A trajectory of balls that glide at constant velocity and then stop dead."""

    complete = True

    def __init__(self, start, velocity, duration, events=()):
        self._start = np.asarray(start, dtype=float)
        self._velocity = np.broadcast_to(velocity, self._start.shape)
        self.duration = duration
        self.final_positions = self._start + self._velocity * duration
        self.final_velocities = np.zeros_like(self._start)
        self.events = np.zeros(len(events), EVENT)
        self.events['t'] = [t for t, _ in events]
        self.events['kind'] = [kind for _, kind in events]

    def positions(self, times):
        times = np.asarray(times, dtype=float)
        assert np.all((times >= 0.0) & (times < self.duration)), 'looked up outside the shot'
        return self._start + self._velocity * times[:, np.newaxis, np.newaxis]

    def velocities(self, times):
        return np.broadcast_to(self._velocity, (len(times), *self._velocity.shape))


class Recorder:
    """An output of the runner that keeps what it is sent, in order."""

    def __init__(self):
        self.sent = []
        self.open = True

    def _keep(self, kind, item):
        self.sent.append((kind, item))

    def prepare(self, block):
        self.block = block

    def frame(self, frame):
        self._keep('frame', frame)

    def clock(self, stamp):
        self._keep('clock', stamp)

    def responses(self, responses):
        for response in responses:
            self._keep('response', response)

    def state(self, state):
        self._keep('state', state)

    def table(self, settings):
        self._keep('table', settings.table)

    def diagnostics(self, stamp, diagnosis):
        self._keep('diagnostics', (stamp, diagnosis))

    def tell(self, line):
        self._keep('tell', line)

    def fail(self, line):
        self._keep('fail', line)
        self.open = False

    def is_open(self):
        return self.open

    def all(self, kind):
        return [item for sent, item in list(self.sent) if sent == kind]
