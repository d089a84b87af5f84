"""Decoders of EXT_meshopt_compression, bitstreams of version 0 (attributes) and 1 (triangles, indices).

After the extension's published specification (Khronos glTF registry, EXT_meshopt_compression, appendix A); no package
with wheels decodes them. Damage is a `ValueError`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Bytes = NDArray[np.uint8]
_BLOCK_BYTES, _BLOCK_MOST, _GROUP = 8192, 256, 16
_TAIL = 32
_FIELDS = {
    bits: [tuple(byte >> shift & (1 << bits) - 1 for shift in range(8 - bits, -1, -bits)) for byte in range(256)]
    for bits in (2, 4)
}
"""What a byte holds, the first in its highest bits."""


def decoded(data: bytes, *, mode: str, count: int, stride: int) -> bytes:
    """`count` elements of `stride` bytes out of a compressed buffer view of that mode."""
    decoders = {"ATTRIBUTES": _attributes, "TRIANGLES": _triangles, "INDICES": _indices}
    if mode not in decoders:
        raise ValueError(f"the mode {mode} is not known")
    if count < 0 or not 0 < stride <= 256 or count > 1 << 28:
        raise ValueError("its counts are broken")
    try:
        return decoders[mode](data, count, stride)
    except IndexError as error:
        raise ValueError("it is cut short") from error


def filtered(data: bytes, *, filter: str, stride: int) -> bytes:
    """Decoded attributes with their filter undone; octahedral ones, which only normals and tangents are, as they
    are."""
    if filter == "EXPONENTIAL":
        raw = np.frombuffer(data, dtype="<i4")
        mantissa = (raw << 8) >> 8
        return np.ldexp(mantissa.astype(np.float64), raw >> 24).astype("<f4").tobytes()
    if filter == "QUATERNION" and stride == 8:
        raw = np.frombuffer(data, dtype="<i2").reshape(-1, 4).astype(np.int64)
        values = np.zeros((len(raw), 4))
        values[:, :3] = raw[:, :3] * (np.sqrt(0.5) / (raw[:, 3:] | 3))
        values[:, 3] = np.sqrt(np.maximum(1.0 - (values[:, :3] ** 2).sum(axis=1), 0.0))
        place = (raw[:, 3:] & 3) + np.array([1, 2, 3, 0])
        turned = np.zeros_like(values)
        np.put_along_axis(turned, place & 3, values, axis=1)
        return np.round(turned * 32767.0).astype("<i2").tobytes()
    return data


def _attributes(data: bytes, count: int, stride: int) -> bytes:
    if data[:1] != b"\xa0":
        raise ValueError("its attributes are of a version that is not readable here")
    if stride % 4:
        raise ValueError("its counts are broken")
    end = len(data) - max(stride, _TAIL)
    if end < 1:
        raise ValueError("it is cut short")
    result: Bytes = np.zeros((count, stride), dtype=np.uint8)
    last = np.frombuffer(data[len(data) - stride :], dtype=np.uint8)
    most = min(_BLOCK_BYTES // stride & ~(_GROUP - 1), _BLOCK_MOST)
    at = 1
    for start in range(0, count, most):
        block = result[start : start + most]
        for column in range(stride):
            deltas, at = _column(data, at, end, len(block))
            zigzag = (deltas >> 1) ^ -(deltas & 1)
            block[:, column] = (int(last[column]) + np.cumsum(zigzag.astype(np.int64))) & 255
        last = block[-1]
    if at != end:
        raise ValueError("its length is wrong")
    return result.tobytes()


def _column(data: bytes, at: int, end: int, count: int) -> tuple[NDArray[np.int64], int]:
    """The differences (zigzag) of one byte of a block's elements, and where the next begin."""
    groups = -(-count // _GROUP)
    head = data[at : at + -(-groups // 4)]
    at += len(head)
    values: list[int] = []
    for group in range(groups):
        kind = head[group >> 2] >> 2 * (group & 3) & 3
        if kind == 0:
            values += (0,) * _GROUP
            continue
        if kind == 3:
            values += data[at : at + _GROUP]
            at += _GROUP
            continue
        bits = 2 * kind
        sentinel, packed = (1 << bits) - 1, data[at : at + 2 * bits]
        at += 2 * bits
        table = _FIELDS[bits]
        for byte in packed:
            for value in table[byte]:
                if value == sentinel:
                    value = data[at]
                    at += 1
                values.append(value)
    if at > end or len(values) != groups * _GROUP:
        raise ValueError("it is cut short")
    return np.array(values[:count], dtype=np.int64), at


class _Stream:
    """Numbers of seven bits a byte."""

    def __init__(self, data: bytes, at: int) -> None:
        self.data, self.at = data, at

    def byte(self) -> int:
        """The next byte."""
        self.at += 1
        return self.data[self.at - 1]

    def number(self) -> int:
        """The next number; at most five bytes."""
        value = 0
        for shift in range(0, 35, 7):
            byte = self.byte()
            value |= (byte & 127) << shift
            if byte < 128:
                break
        return value

    def near(self, last: int) -> int:
        """The next number, stored as its difference from another."""
        value = self.number()
        return (last + ((value >> 1) ^ -(value & 1))) & 0xFFFFFFFF


def _indices(data: bytes, count: int, stride: int) -> bytes:
    if data[:1] != b"\xd1":
        raise ValueError("its indices are of a version that is not readable here")
    stream, last = _Stream(data, 1), [0, 0]
    found = []
    for _ in range(count):
        value = stream.number()
        which = value & 1
        value >>= 1
        last[which] = (last[which] + ((value >> 1) ^ -(value & 1))) & 0xFFFFFFFF
        found.append(last[which])
    return _whole(found, stride)


def _triangles(data: bytes, count: int, stride: int) -> bytes:
    if data[:1] != b"\xe1" or count % 3:
        raise ValueError("its triangles are of a version that is not readable here")
    codes, table = data[1 : 1 + count // 3], data[len(data) - 16 :]
    if len(codes) < count // 3 or len(data) < 17 + count // 3:
        raise ValueError("it is cut short")
    stream = _Stream(data, 1 + len(codes))
    edges: list[tuple[int, int]] = [(0, 0)] * 16
    points: list[int] = [0] * 16
    # Both hold the last 16, the newest last.
    next_, last = 0, 0
    found: list[int] = []

    for code in codes:
        if code < 0xF0:
            a, b = edges[15 - (code >> 4)]
            near = code & 15
            fresh = True
            if near == 0:
                c, next_ = next_, next_ + 1
            elif near < 13:
                c, fresh = points[16 - 1 - near], False
            else:
                c = last = stream.near(last) if near == 15 else last + (near - (near ^ 3))
            if fresh:
                points = [*points[1:], c]
            edges = [*edges[2:], (c, b), (a, c)]
        else:
            plain = code < 0xFE
            further = table[code & 15] if plain else stream.byte()
            if not plain and further == 0:
                next_ = 0
            first, second, third = (0 if plain or code == 0xFE else 15), further >> 4, further & 15
            corners, new = [], []
            for kind in (first, second, third):
                if kind == 0:
                    corner, next_ = next_, next_ + 1
                elif kind < 15 or plain:
                    corner = points[16 - kind]
                else:
                    corner = -1
                corners.append(corner)
                new.append(kind == 0 or (kind == 15 and not plain))
            for k, corner in enumerate(corners):
                if corner < 0:
                    corners[k] = last = stream.near(last)
            a, b, c = corners
            points = [*points, *(v for v, fresh in zip(corners, new, strict=True) if fresh)][-16:]
            edges = [*edges[3:], (b, a), (c, b), (a, c)]
        found += (a, b, c)
    if stream.at > len(data) - 16:
        raise ValueError("it is cut short")
    return _whole(found, stride)


def _whole(found: list[int], stride: int) -> bytes:
    if stride not in (2, 4):
        raise ValueError("its counts are broken")
    return np.array(found, dtype=np.int64).astype(f"<u{stride}").tobytes()
