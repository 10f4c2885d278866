"""Relative equilibria: the frame that turns least, Newton's method, eigenvalues without that of the rotation."""

import numpy as np

from models import complex_parts


def norm(u):
    return np.sqrt(np.einsum("...i,...i->...", u, u))


def turn(model, u):
    """The infinitesimal rotation G u."""
    return (-1j * model.numbers * complex_parts(u)).view(float)


def frame(model, cells, u):
    """Turning rates of the frame of least motion, and how fast the shape changes in it."""
    rate, turned = model.field(cells, u), turn(model, u)
    length = np.einsum("...i,...i->...", turned, turned)
    omega = np.einsum("...i,...i->...", turned, rate) / np.maximum(length, 1e-300)
    return omega, norm(rate - omega[..., None] * turned)


def newton(model, cells, u):
    """Relative equilibria beside u: shapes, turning rates, residuals, rates of the eigenvalues."""
    u, omega = u.copy(), frame(model, cells, u)[0]
    dim = u.shape[-1]
    generator = np.stack([turn(model, e) for e in np.eye(dim)], axis=1)
    for _ in range(12):
        turned = u @ generator.T
        residual = model.field(cells, u) - omega[:, None] * turned
        if not np.any(norm(residual) > 1e-14 * (1e-3 + norm(u))):
            break
        matrix = model.jacobian(cells, u) - omega[:, None, None] * generator
        step = -(np.linalg.pinv(np.concatenate([matrix, -turned[..., None]], axis=2), rcond=1e-11) @ residual[..., None])
        step = np.nan_to_num(step[..., 0])
        u, omega = u + step[:, :dim], omega + step[:, dim]
        if np.all(np.abs(step) < 1e-13):
            break
    turned = u @ generator.T
    residual = norm(model.field(cells, u) - omega[:, None] * turned)
    matrix = model.jacobian(cells, u) - omega[:, None, None] * generator
    return u, omega, residual, eigenvalues(matrix, turned)


def eigenvalues(matrix, turned):
    """Real parts, largest first, without that of the rotation (which becomes -1e3)."""
    length = norm(turned)[:, None]
    unit = np.where(length > 1e-9, turned / np.maximum(length, 1e-300), 0.0)
    along = unit[:, :, None] * unit[:, None, :]
    off = np.eye(matrix.shape[-1]) - along
    return np.sort(np.linalg.eigvals(off @ matrix @ off - 1e3 * along).real, axis=1)[:, ::-1]


def odd_rates(model, cells, shape):
    """Growth and slowest decay among what breaks the two-fold symmetry of a motionless shape: the odd amplitudes."""
    odd = np.repeat(model.numbers % 2 == 1, 2)
    matrix = model.jacobian(cells, shape)[0][np.ix_(odd, odd)]
    rates = np.linalg.eigvals(matrix).real
    return rates.max(), max(rates[rates < 0], default=0.0)
