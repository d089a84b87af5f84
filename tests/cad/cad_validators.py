"""What OpenUSD's validators and omniverse-asset-validator call an error in a file."""

from __future__ import annotations

import logging
from pathlib import Path

import pytest
from pxr import Usd, UsdValidation


def errors_of(path: Path) -> list[tuple[str, str]]:
    """(rule, words) of every error. The engines' schemas have to be registered before."""
    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    stage = Usd.Stage.Open(str(path))
    assert not stage.GetCompositionErrors()
    found = [
        (error.GetValidator().GetMetadata().name, error.GetErrorAsString())
        for error in context.Validate(stage)
        if error.GetType() == UsdValidation.ValidationErrorType.Error
    ]
    validator = pytest.importorskip("omni.asset_validator")
    logging.getLogger("omni").setLevel(logging.ERROR)
    severe = (validator.IssueSeverity.ERROR, validator.IssueSeverity.FAILURE)
    issues = validator.ValidationEngine(variants=False).validate(str(path)).issues()
    return found + [(i.rule.__name__, f"{i.message} {i.at}") for i in issues if i.severity in severe]
