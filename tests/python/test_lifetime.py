"""When the library's cloths are destroyed, and cloths on several threads."""

from __future__ import annotations

import gc
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import muslin
from muslin import Cloth, Error, Status
from muslin._generated.structs import MuslinSkin
from muslin._library import lib
from muslin._views import empty_view


class Log:
    """Counts the cloths that the library creates and destroys."""

    def __enter__(self) -> Log:
        gc.collect()  # cloths of other tests
        self.messages: list[tuple[str, str]] = []
        muslin.set_log(lambda level, message: self.messages.append((level, message)))
        return self

    def __exit__(self, *_error: object) -> None:
        muslin.set_log(None)

    def count(self, word: str) -> int:
        return sum(word in message for _, message in self.messages)


def test_a_forgotten_cloth_is_destroyed() -> None:
    with Log() as log:
        cloth = Cloth.grid(3, 3)
        assert log.count("created") == 1 and log.count("destroyed") == 0
        del cloth
        gc.collect()
        assert log.count("destroyed") == 1


def test_with_closes_a_cloth_and_calls_are_refused_from_then_on() -> None:
    with Log() as log:
        with Cloth.grid(3, 3) as cloth:
            assert not cloth.closed
        assert cloth.closed and log.count("destroyed") == 1
        cloth.close()
        assert log.count("destroyed") == 1
    assert repr(cloth) == "<muslin.Cloth, closed>"
    for call in [cloth.step, cloth.save, cloth.reset, lambda: cloth.positions, lambda: cloth.stats]:
        with pytest.raises(Error) as caught:
            call()
        assert caught.value.status == Status.BAD_HANDLE and caught.value.field == "cloth"


def test_a_refused_cloth_leaves_nothing_behind() -> None:
    with Log() as log:
        with pytest.raises(Error):
            Cloth.grid(0, 3)
        gc.collect()
        assert log.count("created") == log.count("destroyed") == 0
        assert [level for level, _ in log.messages] == ["warn"]


def test_a_log_that_raises_does_not_stop_the_call(monkeypatch: pytest.MonkeyPatch) -> None:
    gc.collect()  # cloths of other tests
    printed: list[str] = []
    monkeypatch.setattr(sys, "unraisablehook", lambda event: printed.append(str(event.exc_value)))

    def handler(level: str, message: str) -> None:
        raise RuntimeError("full disk")

    muslin.set_log(handler, "info")
    try:
        assert Cloth.grid(3, 3).particle_count == 9
    finally:
        muslin.set_log(None)
    assert printed == ["full disk", "full disk"]  # it was created and destroyed


def test_the_memory_of_forgotten_cloths_is_used_again() -> None:
    resource = pytest.importorskip("resource", reason="Unix only")

    def peak() -> int:
        """Peak of the resident memory [KiB on Linux]."""
        return int(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)

    size = Cloth.grid(200, 200).stats.bytes // 1024
    before = peak()
    for _ in range(30):
        Cloth.grid(200, 200).step()
    assert peak() - before < 5 * size


def test_a_program_may_end_with_open_cloths_views_and_logs() -> None:
    program = (
        "import muslin; muslin.set_log(lambda *_: None); cloth = muslin.Cloth.grid();"
        "view = cloth.positions; skin = cloth.skin(view, cloth.indices); print('end')"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (0, "end\n", "")


def test_cloths_on_two_threads_give_the_bits_of_one() -> None:
    def run(out: list[int]) -> None:
        cloth = Cloth.grid(60, 60, material="silk", pin_mode="top-corners")
        cloth.step(60)
        out.append(cloth.state_hash())

    alone: list[int] = []
    run(alone)
    together: list[int] = []
    threads = [threading.Thread(target=run, args=(together,)) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert together == alone * 2


def start_stepping(cloth: Cloth, ticks: int) -> threading.Thread:
    """Starts a thread that runs ticks of a cloth, and returns once it is running them."""

    def run() -> None:
        while True:
            try:
                return cloth.step(ticks)
            except Error as error:  # this thread asks for `blend` just now
                assert error.status == Status.BUSY

    thread = threading.Thread(target=run)
    thread.start()
    while thread.is_alive():
        try:
            cloth.blend
        except Error:
            break
    assert thread.is_alive()
    return thread


def test_ticks_release_the_interpreter_and_a_busy_cloth_is_refused() -> None:
    cloth = Cloth.grid(200, 200)
    thread = start_stepping(cloth, 150)
    refused = 0
    # This loop runs only if the call on the other thread has released the interpreter.
    while thread.is_alive():
        try:
            cloth.particle_count
        except Error as error:
            assert error.status == Status.BUSY
            refused += 1
            assert "muslin.Cloth" in repr(cloth)
        time.sleep(0.001)
    thread.join()
    assert refused > 10
    assert cloth.ticks == 150


def test_closing_a_cloth_during_a_call_on_another_thread_waits_for_the_call() -> None:
    with Log() as log:
        cloth = Cloth.grid(200, 200)
        thread = start_stepping(cloth, 100)
        cloth.close()
        assert log.count("destroyed") == 0 and thread.is_alive()
        thread.join()
        gc.collect()
        assert log.count("destroyed") == 1


def test_a_skin_keeps_its_cloth_and_ends_with_it() -> None:
    with Log() as log:
        cloth = Cloth.grid(10, 10)
        skin = cloth.skin(cloth.positions, cloth.indices)
        other = cloth.skin(cloth.positions, cloth.indices)
        positions = skin.positions
        del cloth
        gc.collect()
        assert log.count("destroyed") == 0 and not skin.closed
        skin._cloth.step()  # type: ignore[attr-defined]
        assert not np.array_equal(skin.positions, positions)
        handle = MuslinSkin(skin._live.id)
        skin.close()
        assert skin.closed and not other.closed
        with pytest.raises(Error, match="`skin` must be a live skin"):
            lib.muslin_skin_view(handle, empty_view())
        with pytest.raises(Error, match="`skin` must be open"):
            skin.positions
        other._cloth.close()
        assert other.closed
        with pytest.raises(Error, match="`skin` must be open"):
            other.normals
        del skin, other
        gc.collect()
        assert log.count("destroyed") == 1


def test_a_duplicate_has_the_same_bits_and_its_own_life() -> None:
    with Log() as log:
        cloth = Cloth.grid(10, 10)
        cloth.step(5)
        copy = cloth.duplicate()
        assert copy.state_hash() == cloth.state_hash() and log.count("created") == 2
        before = copy.state_hash()
        for each in (cloth, copy):
            each.step(3)
        assert copy.state_hash() == cloth.state_hash() != before
        del cloth
        gc.collect()
        copy.step(1)
        assert log.count("destroyed") == 1 and copy.ticks == 9


def test_many_cloths_advance_in_one_call() -> None:
    first = Cloth.grid(10, 10, material="silk")
    cloths = [first, *(first.duplicate() for _ in range(3))]
    alone = first.duplicate()
    ticks = Cloth.advance_many(cloths, 0.04)
    assert ticks.dtype == np.uint32 and ticks.tolist() == [2] * 4 and alone.advance(0.04) == 2
    assert {cloth.state_hash() for cloth in cloths} == {alone.state_hash()}
    assert len(Cloth.advance_many([], 0.04)) == 0
    closed = Cloth.grid(3, 3)
    closed.close()
    for wrong, rule in [(closed, "be an open"), (None, "be an open"), (first, "be another cloth")]:
        with pytest.raises(Error, match=rule) as caught:
            Cloth.advance_many([*cloths, wrong], 0.04)  # type: ignore[list-item]
        assert caught.value.field == "cloths[4]"
    with pytest.raises(Error, match="`seconds` must"):
        Cloth.advance_many(cloths, -1)
    busy = Cloth.grid(200, 200)
    thread = start_stepping(busy, 60)
    with pytest.raises(Error) as caught:
        Cloth.advance_many([*cloths, busy], 0.04)
    thread.join()
    assert (caught.value.status, caught.value.field) == (Status.BUSY, "cloths[4]")
    assert {cloth.ticks for cloth in cloths} == {2}
