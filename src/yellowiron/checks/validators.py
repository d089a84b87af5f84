"""OpenUSD's own validators (`pxr.UsdValidation`): what they say as findings `USD:<name>`, in their own severity."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePosixPath

from pxr import Tf, Usd, UsdValidation

from yellowiron.checks.reading.layers import PROVIDED, name_of
from yellowiron.model.finding import Finding, Severity

_SEVERITIES: dict[object, Severity] = {
    UsdValidation.ValidationErrorType.Error: "error",
    UsdValidation.ValidationErrorType.Warn: "warning",
    UsdValidation.ValidationErrorType.Info: "info",
}
_MDL = "sourceType 'mdl'"
_HINT = "See the documentation of OpenUSD's validator {}."


def validate(stage: Usd.Stage) -> list[Finding]:
    """Every validator that is registered, on the whole stage. Findings come sorted: the validators run in parallel."""
    context = UsdValidation.ValidationContext(UsdValidation.ValidationRegistry().GetOrLoadAllValidators())
    try:
        said = context.Validate(stage)
    except Tf.ErrorException as error:  # some stop at a value of the wrong type instead of reporting it
        where, reason = name_of(stage.GetRootLayer()), " ".join(str(error).split())[-200:]
        message = f"OpenUSD's validators stopped: {reason}"
        return [Finding("USD:NotValidated", "warning", where, message, "Correct the errors above, and check again.")]
    found = {_finding(error, stage) for error in said if not _is_provided(error)}
    return sorted(found, key=lambda f: (f.code, f.where, f.message))


def _is_provided(error: UsdValidation.ValidationError) -> bool:
    """MDL materials are an application's own: neither their library nor their shaders are known outside of it."""
    message = error.GetMessage()
    if error.GetName() == "UnresolvableDependency":
        return message.rstrip("'.").endswith(PROVIDED)
    return error.GetName() == "MissingSourceTypeInRegistry" and _MDL in message


def _finding(error: UsdValidation.ValidationError, stage: Usd.Stage) -> Finding:
    folder = str(PurePosixPath(stage.GetRootLayer().realPath.replace("\\", "/")).parent)
    return Finding(
        code=f"USD:{error.GetName()}",
        severity=_SEVERITIES.get(error.GetType(), "info"),
        where=next(_sites(error), name_of(stage.GetRootLayer())),
        message=" ".join(error.GetMessage().replace(f"{folder}/", "").split()),
        hint=_HINT.format(error.GetValidator().GetMetadata().name),
    )


def _sites(error: UsdValidation.ValidationError) -> Iterator[str]:
    for site in error.GetSites():
        if site.IsPrim() and not site.GetPrim().IsPseudoRoot():
            yield str(site.GetPrim().GetPath())
        elif site.IsProperty():
            yield str(site.GetProperty().GetPath())
        elif site.GetLayer():
            yield name_of(site.GetLayer())
