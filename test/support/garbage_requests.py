"""Send garbage to the services of a node, as rclpy cannot: by another implementation of DDS.

    python garbage_requests.py SEED SERVICE TYPE [SERVICE TYPE ...]

SERVICE is a name without its first slash, TYPE that of its requests in DDS. What is sent has the
right type by name, but is a sequence of random bytes. Ends when all of it was received.
"""

import os
import random
import sys
import time
from dataclasses import dataclass

from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.types import sequence, uint8
from cyclonedds.pub import DataWriter
from cyclonedds.topic import Topic
from cyclonedds.util import duration

ROUNDS = 100
LENGTHS = (0, 1, 3, 4, 8, 12, 40, 400, 5000)
PATIENCE = 60.0
RELIABLE = Qos(
    Policy.Reliability.Reliable(duration(seconds=PATIENCE)),
    Policy.DataRepresentation(use_cdrv0_representation=True),  # the encoding of ROS
)
LOOPBACK_ONLY = """<CycloneDDS><Domain>
<General>
  <Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces>
  <AllowMulticast>false</AllowMulticast>
</General>
<Discovery>
  <ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>60</MaxAutoParticipantIndex>
  <Peers><Peer address="127.0.0.1"/></Peers>
</Discovery>
</Domain></CycloneDDS>"""


def writer(participant, service, type_name):
    """Return a writer to a service, and the class of what it writes."""

    @dataclass
    class Garbage(IdlStruct, typename=type_name):
        data: sequence[uint8]

    topic = Topic(participant, f'rq/{service}Request', Garbage, qos=RELIABLE)
    return DataWriter(participant, topic), Garbage


def main() -> None:
    seed, *services = sys.argv[1:]
    choose = random.Random(int(seed))
    os.environ['CYCLONEDDS_URI'] = LOOPBACK_ONLY
    participant = DomainParticipant(int(os.environ['ROS_DOMAIN_ID']))
    writers = [
        writer(participant, service, type_name)
        for service, type_name in zip(services[::2], services[1::2], strict=True)
    ]
    end = time.monotonic() + PATIENCE
    while not all(to.get_matched_subscriptions() for to, _ in writers):
        if time.monotonic() > end:
            sys.exit('not every service was found')
        time.sleep(0.05)
    for _ in range(ROUNDS):
        for to, garbage in writers:
            to.write(garbage(choose.randbytes(choose.choice(LENGTHS))))
    for to, _ in writers:
        if not to.wait_for_acks(duration(seconds=PATIENCE)):
            sys.exit('not everything was received')


if __name__ == '__main__':
    main()
