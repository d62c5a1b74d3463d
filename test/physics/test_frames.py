"""Results as labelled tables."""

import builtins
import json

import numpy as np
import pandas
import pytest
import xarray

from pool_sim_ros import __version__
from pool_sim_ros.physics import (
    EventKind,
    Table,
    pool_table,
    report_table,
    simulate,
    simulate_many,
    table_from_fields,
)

TABLE = report_table()
VELOCITIES = [(-4.0, 0.0), (0.0, 0.0), (-3.0, 0.5)]


@pytest.fixture(scope='module')
def outcomes():
    return simulate_many(TABLE, VELOCITIES, events=True)


def test_events_have_words_and_labels():
    shot = simulate(TABLE, VELOCITIES[0])
    frame = shot.events_frame()
    assert len(frame) == len(shot.events) > 10
    for name in ('t', 'a', 'b', 'x', 'y', 'nx', 'ny', 'speed'):
        assert (frame[name].to_numpy() == shot.events[name]).all()
    for row, event in zip(frame.itertuples(), shot.events, strict=True):
        assert row.kind == EventKind(event['kind']).name.lower()
        assert row.ball == TABLE.labels[event['a']]
        if event['kind'] == EventKind.BALL_BALL:
            assert row.other == TABLE.labels[event['b']]
        else:
            assert pandas.isna(row.other)
    assert frame.groupby('kind', observed=True).size()['ball_ball'] > 2


def test_pockets_are_no_balls():
    table = pool_table('7ft')
    places, hole = table.positions.copy(), table.pockets[0, :2]
    places[0] = hole + 0.2 * (np.array([table.length, table.width]) / 2 - hole)
    frame = simulate(table, 2.0 * (hole - places[0]), positions=places).events_frame()
    caught = frame[frame.kind == 'pocketed']
    assert list(caught.ball) == ['C'] and list(caught.b) == [0] and caught.other.isna().all()


def test_a_shot_without_events_has_an_empty_frame():
    frame = simulate(TABLE, (0.0, 0.0)).events_frame()
    assert len(frame) == 0 and {'t', 'kind', 'ball', 'other'} < set(frame.columns)


def test_the_events_of_many_shots_name_their_shot(outcomes):
    frame = outcomes.events_frame(TABLE)
    assert frame.columns[0] == 'shot' and len(frame) == len(outcomes.events)
    for k in (0, 2):
        alone = simulate(TABLE, VELOCITIES[k]).events_frame()
        rest = frame[frame.shot == k].drop(columns='shot').reset_index(drop=True)
        pandas.testing.assert_frame_equal(rest, alone)
    assert not (frame.shot == 1).any()


def test_a_dataset_has_names_units_and_the_table(outcomes, tmp_path):
    data = outcomes.to_xarray(TABLE)
    assert dict(data.sizes) == {'shot': 3, 'ball': 11, 'axis': 2}
    end = data.finals.sel(ball='9', axis='y')
    assert (end.to_numpy() == outcomes.finals[:, TABLE.index('9'), 1]).all()
    for name in ('finals', 'durations', 'event_counts', 'pocketed', 'first_hit', 'failed'):
        assert (data[name].to_numpy() == getattr(outcomes, name)).all()
        assert data[name].attrs['units'] and data[name].attrs['long_name']
    assert data.finals.attrs['units'] == 'm' and data.durations.attrs['units'] == 's'
    assert data.attrs['pool_sim_ros'] == __version__
    assert table_from_fields(json.loads(data.attrs['table'])) == TABLE
    data.pocketed[0, 0] = 3  # an array of its own, not the one that stands for all
    assert (outcomes.pocketed == -1).all()
    assert isinstance(data, xarray.Dataset)


def test_without_a_table_balls_have_numbers(outcomes):
    data, frame = outcomes.to_xarray(), outcomes.events_frame()
    assert data.ball.to_numpy().tolist() == list(range(11)) and 'table' not in data.attrs
    assert (data.finals.sel(ball=9).to_numpy() == outcomes.finals[:, 9]).all()
    labelled = outcomes.events_frame(TABLE)
    pandas.testing.assert_frame_equal(frame, labelled.drop(columns=['ball', 'other']))


@pytest.mark.parametrize('name', ['to_xarray', 'events_frame'])
def test_a_table_with_other_balls_is_refused(outcomes, name):
    with pytest.raises(ValueError, match='^table: it has 16 balls, but the outcomes are of 11$'):
        getattr(outcomes, name)(pool_table('7ft'))


def test_where_no_events_were_kept_there_is_no_frame():
    with pytest.raises(ValueError, match='^events: none were kept; simulate_many'):
        simulate_many(TABLE, VELOCITIES).events_frame(TABLE)


@pytest.mark.parametrize(
    ('call', 'line'),
    [
        (lambda o: o.to_xarray(TABLE), 'to_xarray() needs xarray'),
        (lambda o: o.events_frame(TABLE), 'a frame of events needs pandas'),
        (lambda o: simulate(TABLE, (0.0, 0.0)).events_frame(), 'a frame of events needs pandas'),
    ],
)
def test_without_the_package_one_line_names_the_extra(outcomes, call, line, monkeypatch):
    found = builtins.__import__

    def without(module, *args, **kwargs):
        if module in ('pandas', 'xarray'):
            raise ModuleNotFoundError(f'No module named {module!r}', name=module)
        return found(module, *args, **kwargs)

    monkeypatch.setattr(builtins, '__import__', without)
    with pytest.raises(ModuleNotFoundError) as caught:
        call(outcomes)
    told = f'{line}, not installed here: pip install {line.split()[-1]} '
    assert str(caught.value) == f'{told}(the extra frames has all that it needs)'


def test_large_results_stay_arrays():
    many = simulate_many(TABLE, np.tile(VELOCITIES, (100, 1)))
    assert many.to_xarray(TABLE).sizes['shot'] == 300
    assert isinstance(TABLE, Table)
