"""Every generator of machines by its kind: what draws one of a seed, and the type that it is."""

from __future__ import annotations

from collections.abc import Callable
from types import MappingProxyType

from kit.machines.articulated_trucks import articulated_truck
from kit.machines.backhoes import backhoe
from kit.machines.cranes import crane
from kit.machines.crawler_cranes import crawler_crane
from kit.machines.dozers import dozer
from kit.machines.graders import grader
from kit.machines.lift_trucks import lift_truck
from kit.machines.rigid_trucks import rigid_truck
from kit.machines.rollers import roller
from kit.machines.skid_steers import skid_steer
from kit.machines.synthetic import Machine
from kit.machines.telehandlers import telehandler
from kit.machines.wheeled_excavators import wheeled_excavator

Drawer = Callable[[int], Machine]

DRAWERS: MappingProxyType[str, tuple[Drawer, str]] = MappingProxyType(
    {
        "articulated truck": (articulated_truck, "articulated_dump_truck"),
        "backhoe": (backhoe, "backhoe_loader"),
        "crane": (crane, "mobile_crane"),
        "crawler crane": (crawler_crane, "crawler_crane"),
        "dozer": (dozer, "dozer"),
        "forklift": (lift_truck, "forklift"),
        "grader": (grader, "grader"),
        "rigid truck": (rigid_truck, "rigid_dump_truck"),
        "roller": (roller, "roller"),
        "skid steer": (skid_steer, "skid_steer"),
        "telehandler": (telehandler, "telehandler"),
        "wheeled excavator": (wheeled_excavator, "wheeled_excavator"),
    }
)
"""Beside loaders and excavators, which are drawn with defects of their own (`kit.machines.defects`)."""
