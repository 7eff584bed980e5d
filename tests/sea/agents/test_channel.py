"""The channel: ranges, delays, turns, and the two kinds of loss."""

import math
from dataclasses import dataclass, field

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.sea.agents.channel import PRESETS, SOUND_SPEED, Bursts, Channel, Radio
from fiveroute.sea.agents.messages import (
    Accept,
    Bid,
    Call,
    Message,
    Report,
    Wish,
    longest_frame,
)
from fiveroute.sea.events import Frame, arrivals_of
from fiveroute.sea.luck import Luck
from fiveroute.sea.run import Run
from fiveroute.sea.world import World


@dataclass(slots=True)
class Ears:
    """Everything that was heard: time, AUV, message."""

    heard: list[tuple[float, int, Message]] = field(default_factory=list)

    def __call__(self, t: float, auv: int, message: Message) -> None:
        self.heard.append((t, auv, message))


class Stay:
    """A crew that goes straight home."""

    def __init__(self, destination: int) -> None:
        self.destination = destination

    def steer(self, auv: int, t: float) -> int:
        return self.destination

    def come_home(self, auv: int, t: float) -> None:
        pass


def fleet(world: World, channel: Channel, ears: Ears, size: int = 3) -> tuple[Run, Radio]:
    problem = world.problem.with_budgets([18_000.0] * size)
    run = Run(problem, Luck(world.law, 1, 0), (math.inf,) * size)
    rng, longest = np.random.default_rng(3), longest_frame(problem.n)
    return run, Radio(run, channel, world.points, rng, ears, longest)


def test_a_message_takes_its_bits_and_the_way_of_sound(world: World) -> None:
    ears = Ears()
    run, radio = fleet(world, Channel(bit_rate=100.0), ears)
    radio.send(0.0, Accept(0, 2, 1, 5))
    run.vessels[2].at = run.vessels[2].target = 7
    distance = np.hypot(*(world.points[7] - world.points[0]))
    run.sail(Stay(world.problem.destination))
    ((t, auv, message),) = ears.heard
    assert (auv, message) == (2, Accept(0, 2, 1, 5))
    assert t == pytest.approx(68.0 / 100.0 + distance / SOUND_SPEED)


def test_everybody_hears_what_is_for_everybody_but_the_sender(world: World) -> None:
    ears = Ears()
    run, radio = fleet(world, Channel(), ears)
    radio.send(0.0, Wish(1, None, frozenset({2})))
    run.sail(Stay(world.problem.destination))
    assert sorted(auv for _, auv, _ in ears.heard) == [0, 2]
    assert (radio.sent, radio.delivered) == (1, 2)


def test_the_log_pairs_who_speaks_with_who_hears(world: World) -> None:
    ears = Ears()
    run, radio = fleet(world, Channel(loss=0.4), ears)
    radio.send(0.0, Wish(1, None, frozenset({2})))
    for number in range(20):
        radio.send(0.0, Accept(0, 2, number, 5))
    run.sail(Stay(world.problem.destination))
    sent = [event.frame for event in run.log if event.kind == "send"]
    assert sent[0] == Frame(0, 0, 2, "accept", 68)
    assert sent[1] == Frame(1, 1, None, "wish", 36 + world.problem.n)
    assert [frame.number for frame in sent if frame] == list(range(21))
    arrivals = arrivals_of(run.log)
    heard = [(t, auv) for told in arrivals.values() for auv, t in told.items()]
    assert sorted(heard) == [(t, auv) for t, auv, _ in ears.heard]
    assert 0 < len(heard) < 21


def test_an_auv_sends_in_its_turns_only(world: World) -> None:
    run, radio = fleet(world, Channel(), Ears())
    for auv in (2, 0, 0, 1):
        radio.send(0.0, Accept(auv, (auv + 1) % 3, 1, 5))
    run.sail(Stay(world.problem.destination))
    sent = [event for event in run.log if event.kind == "send"]
    assert [event.auv for event in sent] == [0, 1, 2, 0]
    turns = [0.0, radio.slot, 2.0 * radio.slot, radio.cycle]
    assert [event.t for event in sent] == pytest.approx(turns)


def test_nobody_is_heard_out_of_reach(world: World) -> None:
    ears = Ears()
    run, radio = fleet(world, Channel(reach=100.0), ears)
    run.vessels[2].at = run.vessels[2].target = 7
    radio.send(0.0, Wish(0, None, frozenset()))
    run.sail(Stay(world.problem.destination))
    assert [auv for _, auv, _ in ears.heard] == [1]


@pytest.mark.parametrize(
    ("channel", "share"),
    [
        (Channel(loss=0.3), 0.3),
        (Channel(loss=1.0), 1.0),
        (Channel(bursts=Bursts(0.05, 0.25, 0.9)), 0.9 / 6.0),
    ],
)
def test_as_much_is_lost_as_stated(world: World, channel: Channel, share: float) -> None:
    _, radio = fleet(world, channel, Ears())
    lost = np.array([radio._is_lost(0, 1) for _ in range(20_000)])
    assert lost.mean() == pytest.approx(share, abs=0.02)
    if channel.bursts is not None:
        assert lost[1:][lost[:-1]].mean() > 3.0 * lost.mean()


def test_delays_may_reorder(world: World) -> None:
    ears = Ears()
    run, radio = fleet(world, Channel(jitter=300.0), ears)
    for number in range(8):
        radio.send(0.0, Accept(0, 1, number, 5))
    run.sail(Stay(world.problem.destination))
    order = [m.transfer for _, _, m in ears.heard if isinstance(m, Accept)]
    assert sorted(order) == list(range(8)) != order


def test_every_message_states_its_bits() -> None:
    empty: frozenset[int] = frozenset()
    assert Report(0, None, empty, empty, empty, False, False).bits(60) == 36 + 3 * 60 + 2
    assert Call(0, None, 1, (4, 5)).bits(60) == 36 + 16 * 3
    assert Bid(0, 1, 1, (0.5, 0.0)).bits(60) == 36 + 16 * 3
    assert Accept(0, 1, 1, 4).bits(60) == 36 + 32
    assert Wish(0, None, empty).bits(60) == 96


def test_presets_are_as_their_makers_say() -> None:
    assert PRESETS["fsk"].bit_rate == 80.0
    assert PRESETS["nanomodem"].reach == 2000.0


@pytest.mark.parametrize("wrong", [{"loss": 1.1}, {"reach": 0.0}, {"jitter": -1.0}])
def test_what_makes_no_sense_is_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(InputError):
        Channel(**wrong)  # type: ignore[arg-type]
    with pytest.raises(InputError):
        Bursts(loss=2.0)
