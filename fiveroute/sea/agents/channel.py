"""The acoustic channel: slow, short of range, and unreliable.

Sound covers 1500 m/s, and a modem sends some hundred bits a second. An AUV cannot hear while it
sends, so the fleet takes turns (time division): every AUV has a slot of its own, long enough for
the longest frame and for sound to cross the region, in which it sends one frame. So frames never
collide. A frame reaches every AUV within range unless it is lost: at random, each with the same
probability (Bernoulli), or in bursts, when a link is in its bad state (Gilbert and Elliott).

References
----------
E. N. Gilbert, "Capacity of a burst-noise channel", Bell System Technical Journal 39 (1960), doi
10.1002/j.1538-7305.1960.tb03959.x; E. O. Elliott, ibid. 42 (1963), doi
10.1002/j.1538-7305.1963.tb00955.x.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.sea.agents.messages import Message
from fiveroute.sea.events import Frame
from fiveroute.sea.run import Run, Vessel

__all__ = ["PRESETS", "SOUND_SPEED", "Bursts", "Channel", "Radio"]

SOUND_SPEED = 1500.0
"""Speed of sound in sea water in metres per second."""


def _require_probability(name: str, value: float) -> None:
    if not 0.0 <= value <= 1.0:
        raise InputError("a probability lies between 0 and 1", field=name, value=value)


@dataclass(frozen=True, slots=True)
class Bursts:
    """Loss in bursts: a chain of two states for every link, one step a frame.

    Parameters
    ----------
    worsen, recover
        Probabilities to change from the good to the bad state, and back.
    loss
        Probability that a frame is lost in the bad state.
    """

    worsen: float = 0.05
    recover: float = 0.25
    loss: float = 0.9

    def __post_init__(self) -> None:
        for name in ("worsen", "recover", "loss"):
            _require_probability(name, getattr(self, name))


@dataclass(frozen=True, slots=True)
class Channel:
    """A modem and the water round it.

    Parameters
    ----------
    reach
        Greatest distance in metres over which a frame is heard.
    bit_rate
        Bits per second.
    loss
        Probability that a frame is lost on its way to one receiver (in the good state).
    bursts
        Bad states as well; None for none.
    jitter
        Greatest random delay of a frame in seconds, on top of the sound's way: frames may
        overtake each other.
    """

    reach: float = math.inf
    bit_rate: float = 640.0
    loss: float = 0.0
    bursts: Bursts | None = None
    jitter: float = 0.0

    def __post_init__(self) -> None:
        _require_probability("loss", self.loss)
        for name in ("reach", "bit_rate"):
            if not getattr(self, name) > 0.0:
                raise InputError("must be positive", field=name, value=getattr(self, name))
        if not 0.0 <= self.jitter < math.inf:
            raise InputError("must be finite and not negative", field="jitter", value=self.jitter)


PRESETS = {
    "unlimited": Channel(),
    "fsk": Channel(reach=4000.0, bit_rate=80.0, loss=0.1),  # WHOI Micro-Modem class, FH-FSK
    "psk": Channel(reach=2400.0, bit_rate=5000.0, loss=0.1),  # WHOI Micro-Modem class, PSK
    "nanomodem": Channel(reach=2000.0, bit_rate=463.0, loss=0.1),  # Newcastle Nanomodem V3, net
    "bursty": Channel(reach=4000.0, bit_rate=640.0, bursts=Bursts()),
}
"""Channels by name; ranges and losses are typical, rates are the makers'."""


@dataclass(slots=True)
class Radio:
    """The channel at work in one run.

    Parameters
    ----------
    run
        The run.
    channel
        What it is like.
    points
        Positions of all vertices in metres, shape (n + 2, 2).
    rng
        Draws losses and delays.
    hear
        Called with time, AUV and message when an AUV hears something.
    longest
        Bits of the longest frame that may be sent; a turn is long enough for it.
    sent, delivered
        Frames sent, and frames heard by those whom they were for.
    """

    run: Run
    channel: Channel
    points: NDArray[np.float64]
    rng: np.random.Generator
    hear: Callable[[float, int, Message], None]
    longest: int
    sent: int = 0
    delivered: int = 0
    slot: float = field(init=False)
    _next_turn: list[float] = field(init=False)
    _waiting: list[deque[Message]] = field(init=False)
    _bad_links: set[tuple[int, int]] = field(default_factory=set)

    def __post_init__(self) -> None:
        fleet, channel = self.run.problem.fleet_size, self.channel
        across = float(np.hypot(*np.ptp(self.points, axis=0)))
        self.slot = self.longest / channel.bit_rate + min(across, channel.reach) / SOUND_SPEED
        self._next_turn = [auv * self.slot for auv in range(fleet)]
        self._waiting = [deque() for _ in range(fleet)]

    @property
    def cycle(self) -> float:
        """Seconds from one turn of an AUV to the next."""
        return self.slot * self.run.problem.fleet_size

    @property
    def patience(self) -> float:
        """Seconds within which an answer comes, unless something is lost."""
        return 2.0 * self.cycle + self.slot + 2.0 * self.channel.jitter

    def send(self, t: float, message: Message) -> None:
        """Let an AUV send a message when its turn comes, after those that wait already."""
        queue = self._waiting[message.sender]
        queue.append(message)
        if len(queue) == 1:
            self._take_turn(message.sender, t)

    def _take_turn(self, auv: int, t: float) -> None:
        turn = self._next_turn[auv]
        if turn < t:
            turn += math.ceil((t - turn) / self.cycle) * self.cycle
        self._next_turn[auv] = turn + self.cycle
        self.run.schedule(turn, partial(self._transmit, auv))

    def _transmit(self, auv: int, t: float) -> None:
        vessels, message = self.run.vessels, self._waiting[auv].popleft()
        if not vessels[auv].is_alive:
            self._waiting[auv].clear()
            return
        bits = message.bits(self.run.problem.n)
        assert bits <= self.longest, f"{message.says} of {bits} bits in a turn for {self.longest}"
        frame = Frame(self.sent, auv, message.receiver, message.says, bits)
        self.sent += 1
        self.run.note(t, auv, "send", frame=frame)
        here = self._position(vessels[auv], t)
        spoken = t + bits / self.channel.bit_rate
        for other in range(len(vessels)):
            if other == auv or message.receiver not in (None, other):
                continue
            distance = float(np.hypot(*(self._position(vessels[other], t) - here)))
            if self._is_lost(auv, other) or distance > self.channel.reach:
                continue
            late = self.channel.jitter * float(self.rng.random()) if self.channel.jitter else 0.0
            heard = spoken + distance / SOUND_SPEED + late
            self.run.schedule(heard, partial(self._deliver, other, message, frame))
        if self._waiting[auv]:
            self._take_turn(auv, t)

    def _deliver(self, auv: int, message: Message, frame: Frame, t: float) -> None:
        if self.run.vessels[auv].is_alive:
            self.delivered += 1
            self.run.note(t, auv, "receive", frame=frame)
            self.hear(t, auv, message)

    def _is_lost(self, sender: int, receiver: int) -> bool:
        link, bursts, loss = (sender, receiver), self.channel.bursts, self.channel.loss
        if bursts is not None:
            is_bad = link in self._bad_links
            if self.rng.random() < (bursts.recover if is_bad else bursts.worsen):
                self._bad_links ^= {link}
                is_bad = not is_bad
            loss = bursts.loss if is_bad else loss
        return loss > 0.0 and bool(self.rng.random() < loss)

    def _position(self, vessel: Vessel, t: float) -> NDArray[np.float64]:
        here: NDArray[np.float64] = self.points[vessel.at]
        if vessel.target == vessel.at or vessel.due <= vessel.left:
            return here
        share = min((t - vessel.left) / (vessel.due - vessel.left), 1.0)
        there: NDArray[np.float64] = self.points[vessel.target]
        position: NDArray[np.float64] = here + share * (there - here)
        return position
