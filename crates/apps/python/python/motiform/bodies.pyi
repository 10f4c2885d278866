"""The models by name. Written by ``python -m motiform._stubs`` from the registry: do not edit."""

from collections.abc import Mapping

from ._registry import ModelInfo
from .models import Model

__all__ = ["Cell", "Tensor"]

def docstring(info: ModelInfo) -> str: ...

class Tensor(Model):
    """velocity, ellipse and triangle of one domain, coupled by symmetry (6 unknowns, 21 parameters)

    (V) dv_i/dt = gamma v_i - v^2 v_i - a1 S_ij v_j - a2 U_ijk v_j v_k - a3 U_ijk S_jk - a4 S^2 v_i - a5 U^2 v_i + a6 S_ij S_kl U_jkl
    (S) dS_ij/dt = -kappa2 S_ij + b1 (v_i v_j - v^2 delta_ij/2) + b2 U_ijk v_k - b3 S^2 S_ij - b4 v^2 S_ij - b5 U^2 S_ij + b6 U_ijk S_kl v_l
    (U) dU_ijk/dt = -kappa3 U_ijk + d1 [v_i v_j v_k] + d2 [S_ij v_k] - d3 U^2 U_ijk - d4 v^2 U_ijk - d5 S^2 U_ijk + 2 d6 [S_ij S_kl v_l]
        dx_i/dt = v_i;   v^2 = v_i v_i,   S^2 = S_ij S_ij,   U^2 = U_ijk U_ijk
        [..] is the part that is symmetric and traceless in i, j, k; sums over repeated indices
        outline: R(theta) = R0 + S_ij n_i n_j + U_ijk n_i n_j n_k

    Source: Hiraiwa, Ohkuma, Ohta, Matsuo, Sano, EPL (2010), eqs. (V), (S), (U)

    Parameters
    ----------
    gamma : float, default 1
        gamma v: self-propulsion; a circle moves by itself where gamma > 0. (equation (V))
    kappa2 : float, default 1
        -kappa2 S: relaxation rate of the elliptic deformation; negative, the circle is unstable to an ellipse. (equation (S))
    kappa3 : float, default 1
        -kappa3 U: relaxation rate of the three-fold deformation; negative, the circle is unstable to a triangle. (equation (U))
    a1 : float, default 0
        -a1 S v: the ellipse steers the velocity, across its long axis for a1 > 0 and along it for a1 < 0. (equation (V))
    a2 : float, default 0
        -a2 U v v: the triangle steers the velocity. (equation (V))
    a3 : float, default 0
        -a3 U S: ellipse and triangle together propel the body. (equation (V))
    a4 : float, default 0
        -a4 (S:S) v: the ellipse slows the body down for a4 > 0. (equation (V))
    a5 : float, default 0
        -a5 (U:U) v: the triangle slows the body down for a5 > 0. (equation (V))
    a6 : float, default 0
        +a6 S_ij S_kl U_jkl: propulsion by the square of the ellipse with the triangle. (equation (V))
    b1 : float, default 0
        +b1 (v v - v^2/2): motion stretches the body, along the velocity for b1 > 0 and across it for b1 < 0. (equation (S))
    b2 : float, default 0
        +b2 U v: a moving triangle becomes elliptic. (equation (S))
    b3 : float, default 0
        -b3 (S:S) S: saturation of the ellipse; needed where kappa2 < 0. (equation (S))
    b4 : float, default 0
        -b4 v^2 S: motion damps the ellipse for b4 > 0. (equation (S))
    b5 : float, default 0
        -b5 (U:U) S: the triangle damps the ellipse for b5 > 0. (equation (S))
    b6 : float, default 0
        +b6 U S v: a moving triangle turns the ellipse. (equation (S))
    d1 : float, default 0
        +d1 (v v v - trace): motion alone makes the body three-fold. (equation (U))
    d2 : float, default 0
        +d2 (S v - trace): a moving ellipse becomes three-fold (head and tail differ). (equation (U))
    d3 : float, default 0
        -d3 (U:U) U: saturation of the triangle; needed where kappa3 < 0. (equation (U))
    d4 : float, default 0
        -d4 v^2 U: motion damps the triangle for d4 > 0. (equation (U))
    d5 : float, default 0
        -d5 (S:S) U: the ellipse damps the triangle for d5 > 0. (equation (U))
    d6 : float, default 0
        +2 d6 (S S v - trace): the square of the ellipse with the velocity makes the body three-fold. (equation (U))
    """

    def __init__(
        self,
        *,
        initial: Mapping[str, float] | None = None,
        gamma: float = 1.0,
        kappa2: float = 1.0,
        kappa3: float = 1.0,
        a1: float = 0.0,
        a2: float = 0.0,
        a3: float = 0.0,
        a4: float = 0.0,
        a5: float = 0.0,
        a6: float = 0.0,
        b1: float = 0.0,
        b2: float = 0.0,
        b3: float = 0.0,
        b4: float = 0.0,
        b5: float = 0.0,
        b6: float = 0.0,
        d1: float = 0.0,
        d2: float = 0.0,
        d3: float = 0.0,
        d4: float = 0.0,
        d5: float = 0.0,
        d6: float = 0.0,
    ) -> None: ...
    @property
    def gamma(self) -> float:
        """gamma v: self-propulsion; a circle moves by itself where gamma > 0. ((V))"""
    @property
    def kappa2(self) -> float:
        """-kappa2 S: relaxation rate of the elliptic deformation; negative, the circle is unstable to an ellipse. ((S))"""
    @property
    def kappa3(self) -> float:
        """-kappa3 U: relaxation rate of the three-fold deformation; negative, the circle is unstable to a triangle. ((U))"""
    @property
    def a1(self) -> float:
        """-a1 S v: the ellipse steers the velocity, across its long axis for a1 > 0 and along it for a1 < 0. ((V))"""
    @property
    def a2(self) -> float:
        """-a2 U v v: the triangle steers the velocity. ((V))"""
    @property
    def a3(self) -> float:
        """-a3 U S: ellipse and triangle together propel the body. ((V))"""
    @property
    def a4(self) -> float:
        """-a4 (S:S) v: the ellipse slows the body down for a4 > 0. ((V))"""
    @property
    def a5(self) -> float:
        """-a5 (U:U) v: the triangle slows the body down for a5 > 0. ((V))"""
    @property
    def a6(self) -> float:
        """+a6 S_ij S_kl U_jkl: propulsion by the square of the ellipse with the triangle. ((V))"""
    @property
    def b1(self) -> float:
        """+b1 (v v - v^2/2): motion stretches the body, along the velocity for b1 > 0 and across it for b1 < 0. ((S))"""
    @property
    def b2(self) -> float:
        """+b2 U v: a moving triangle becomes elliptic. ((S))"""
    @property
    def b3(self) -> float:
        """-b3 (S:S) S: saturation of the ellipse; needed where kappa2 < 0. ((S))"""
    @property
    def b4(self) -> float:
        """-b4 v^2 S: motion damps the ellipse for b4 > 0. ((S))"""
    @property
    def b5(self) -> float:
        """-b5 (U:U) S: the triangle damps the ellipse for b5 > 0. ((S))"""
    @property
    def b6(self) -> float:
        """+b6 U S v: a moving triangle turns the ellipse. ((S))"""
    @property
    def d1(self) -> float:
        """+d1 (v v v - trace): motion alone makes the body three-fold. ((U))"""
    @property
    def d2(self) -> float:
        """+d2 (S v - trace): a moving ellipse becomes three-fold (head and tail differ). ((U))"""
    @property
    def d3(self) -> float:
        """-d3 (U:U) U: saturation of the triangle; needed where kappa3 < 0. ((U))"""
    @property
    def d4(self) -> float:
        """-d4 v^2 U: motion damps the triangle for d4 > 0. ((U))"""
    @property
    def d5(self) -> float:
        """-d5 (S:S) U: the ellipse damps the triangle for d5 > 0. ((U))"""
    @property
    def d6(self) -> float:
        """+2 d6 (S S v - trace): the square of the ellipse with the velocity makes the body three-fold. ((U))"""

class Cell(Model):
    """active cell: a closed boundary that deforms by itself and moves by its deformation

    (C)     phi_t = g1 phi_ss + g2 phi_ssss + g3 phi_ssssss + g4 phi_s phi_ss + g5 phi_ss phi_sss
            on 0 <= s < length, Fourier components 1 .. modes; normal angle (2 pi / length) (s + phi)
    (VEL)   v = ((2 pi)^2 / length^3) int (alpha2 phi_s^2 + A phi_ss^2) n ds,   A = alpha3 + alpha3_per_length length
    (CLOSE) int n ds = 0, by the most likely error function: components n = 1 .. closure_modes, widths n^-prior
            feedback = 1 adds it to phi after every step
            dx/dt = v

    Source: Hiraiwa, Ohkuma, Ohta, Matsuo, Sano, EPL (2010), eqs. (C), (VEL), (CLOSE)

    Parameters
    ----------
    length : float, default 21.6
        length of the closed boundary; mode n of the shape is unstable for length > 2 pi n. (equation (C))
    g1 : float, default 0
        g1 phi_ss: damps long waves for g1 > 0. (equation (C))
    g2 : float, default 1
        g2 phi_ssss: makes the circle unstable for g2 > 0. (equation (C))
    g3 : float, default 1
        g3 phi_ssssss: damps short waves; above 0, or the equation has no solutions. (equation (C))
    g4 : float, default 0
        g4 phi_s phi_ss: the variational quadratic term. (equation (C))
    g5 : float, default -1
        g5 phi_ss phi_sss: the quadratic term that is not variational and makes the shape move. (equation (C))
    alpha2 : float, default 0
        alpha2 phi_s^2 n: pushes along the normal where the boundary is curved. (equation (VEL))
    alpha3 : float, default 0
        alpha3 phi_ss^2 n: pushes along the normal where the curvature changes (added to alpha3_per_length times length). (equation (VEL))
    alpha3_per_length : float, default -0.0004
        the same as a multiple of the length, as the paper gives it: alpha3 = -4e-4 length. (equation (VEL))
    modes : float, default 21
        number of modes of phi that are computed (a whole number): 21 are a grid of 64 points, 42 one of 128. (equation modes)
    closure_modes : float, default 8
        number of modes of the error function that closes the boundary (a whole number); 0 leaves it open, 1 changes mode 1 alone. (equation (CLOSE))
    prior : float, default 4
        how smooth the error function is expected to be: prior width n^-prior of its mode n; 0 is a flat prior. (equation (CLOSE))
    feedback : float, default 0
        1 adds the error function to phi after every step (a whole number); then nothing moves up to a length of about 15 (measured: 16), which is why it is off. (equation (CLOSE))
    """

    def __init__(
        self,
        *,
        initial: Mapping[str, float] | None = None,
        length: float = 21.6,
        g1: float = 0.0,
        g2: float = 1.0,
        g3: float = 1.0,
        g4: float = 0.0,
        g5: float = -1.0,
        alpha2: float = 0.0,
        alpha3: float = 0.0,
        alpha3_per_length: float = -0.0004,
        modes: float = 21.0,
        closure_modes: float = 8.0,
        prior: float = 4.0,
        feedback: float = 0.0,
    ) -> None: ...
    @property
    def length(self) -> float:
        """length of the closed boundary; mode n of the shape is unstable for length > 2 pi n. ((C))"""
    @property
    def g1(self) -> float:
        """g1 phi_ss: damps long waves for g1 > 0. ((C))"""
    @property
    def g2(self) -> float:
        """g2 phi_ssss: makes the circle unstable for g2 > 0. ((C))"""
    @property
    def g3(self) -> float:
        """g3 phi_ssssss: damps short waves; above 0, or the equation has no solutions. ((C))"""
    @property
    def g4(self) -> float:
        """g4 phi_s phi_ss: the variational quadratic term. ((C))"""
    @property
    def g5(self) -> float:
        """g5 phi_ss phi_sss: the quadratic term that is not variational and makes the shape move. ((C))"""
    @property
    def alpha2(self) -> float:
        """alpha2 phi_s^2 n: pushes along the normal where the boundary is curved. ((VEL))"""
    @property
    def alpha3(self) -> float:
        """alpha3 phi_ss^2 n: pushes along the normal where the curvature changes (added to alpha3_per_length times length). ((VEL))"""
    @property
    def alpha3_per_length(self) -> float:
        """the same as a multiple of the length, as the paper gives it: alpha3 = -4e-4 length. ((VEL))"""
    @property
    def modes(self) -> float:
        """number of modes of phi that are computed (a whole number): 21 are a grid of 64 points, 42 one of 128. (modes)"""
    @property
    def closure_modes(self) -> float:
        """number of modes of the error function that closes the boundary (a whole number); 0 leaves it open, 1 changes mode 1 alone. ((CLOSE))"""
    @property
    def prior(self) -> float:
        """how smooth the error function is expected to be: prior width n^-prior of its mode n; 0 is a flat prior. ((CLOSE))"""
    @property
    def feedback(self) -> float:
        """1 adds the error function to phi after every step (a whole number); then nothing moves up to a length of about 15 (measured: 16), which is why it is off. ((CLOSE))"""
