"""``[accept]``: warnings that the user accepts, each with the reason."""

from collections.abc import Iterable
from typing import Annotated, ClassVar

from geneva_cli.errors import GenevaError, Notice
from geneva_cli.spec.schema import SpecTable

Reason = Annotated[str | None, None, "reason for accepting this warning"]


class Accept(SpecTable):
    """``[accept]``: the reason for each accepted warning, by its name.

    >>> Accept(many_slots="a dial of 30 stations").reasons
    {'many-slots': 'a dial of 30 stations'}
    """

    TABLE: ClassVar[str] = "accept"
    WORDS_APART: ClassVar[str] = "-"  # in the names of warnings

    many_slots: Reason = None
    no_centre_distance: Reason = None
    nothing_holds: Reason = None
    stop_in_motion: Reason = None
    loose_fit: Reason = None
    rounded_points: Reason = None
    turns_back: Reason = None
    off_mid_condition: Reason = None
    soft_shock_at_ends: Reason = None
    soft_shock_at_mid: Reason = None
    not_positively_driven: Reason = None
    steep_hand_over: Reason = None
    undercut: Reason = None
    friction_holds_the_wheel: Reason = None
    sharp_wall: Reason = None
    drives_the_motor: Reason = None
    heavy_inertia: Reason = None
    tiny_machine: Reason = None
    wheel_left_out: Reason = None
    weight_to_one_side: Reason = None
    unbalanced: Reason = None
    unlikely_material: Reason = None
    nothing_to_act_on: Reason = None
    driven_by_one_wall: Reason = None
    lags_behind: Reason = None
    short_motion: Reason = None
    stout_horns: Reason = None
    tolerance_left_out: Reason = None
    not_every_machine_turns: Reason = None
    small_hole: Reason = None
    no_bearing: Reason = None
    gears_without_teeth: Reason = None
    taken_as_built: Reason = None
    outline_units: Reason = None
    ideal_machine: Reason = None
    narrow_for_process: Reason = None

    # warnings of `geneva vibration` and `geneva tolerance` alone
    ELSEWHERE: ClassVar[tuple[str, ...]] = (
        *("short-motion", "tolerance-left-out", "not-every-machine-turns"),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        for name, reason in self.reasons.items():
            if not reason.strip():
                raise GenevaError(
                    f'{name} needs the reason for accepting it, as {name} = "agreed with the '
                    'customer"',
                    (self.TABLE, name),
                )

    @property
    def reasons(self) -> dict[str, str]:
        """The reasons by the names of the accepted warnings."""
        return {name: reason for name, reason in self.as_dict().items() if reason is not None}

    def applied(self, notices: Iterable[Notice]) -> list[Notice]:
        """The warnings, the accepted ones with their reason.

        >>> accept = Accept(many_slots="a dial of 30 stations")
        >>> accept.applied([Notice("many-slots", "z = 30")])
        ['accepted (a dial of 30 stations): z = 30']
        """
        reasons = self.reasons
        return [
            one.accepted_for(reasons[one.name]) if one.name in reasons else one for one in notices
        ]

    def unused(self, notices: Iterable[Notice]) -> list[str]:
        """Names of accepted warnings that do not occur among those of ``check``."""
        names = {one.name for one in notices}
        return [name for name in self.reasons if name not in names and name not in self.ELSEWHERE]
