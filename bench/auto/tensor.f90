! The full tensor model in the frame that turns with the velocity: z1 = r exp(i p), w2 = z2 exp(-2 i p), w3 = z3 exp(-3 i p),
! so that relative equilibria are equilibria and relative periodic orbits periodic ones. Couplings of the paper's Fig. 4.
subroutine func(ndim, u, icp, par, ijac, f, dfdu, dfdp)
  implicit none
  integer, intent(in) :: ndim, icp(*), ijac
  double precision, intent(in) :: u(ndim), par(*)
  double precision, intent(out) :: f(ndim)
  double precision, intent(inout) :: dfdu(ndim, ndim), dfdp(ndim, *)
  double precision :: r, turning
  complex(kind=8) :: w2, w3, f2, f3
  complex(kind=8), parameter :: i = (0.0d0, 1.0d0)
  ! gamma = 1, a1 = -1, b1 = -0.5, b2 = 0.3, d1 = 0.1, d2 = 0.8
  double precision, parameter :: e11 = 2.0d0, e21 = -0.125d0, e22 = 0.3d0, e31 = 0.0125d0, e32 = 0.4d0
  r = u(1)
  w2 = cmplx(u(2), u(3), kind=8)
  w3 = cmplx(u(4), u(5), kind=8)
  turning = e11 * aimag(w2)
  f2 = -par(1) * w2 + e21 * r * r + e22 * r * w3 - 2.0d0 * i * turning * w2
  f3 = -par(2) * w3 + e31 * r**3 + e32 * r * w2 - 3.0d0 * i * turning * w3
  f = [r * (1.0d0 - r * r + e11 * dble(w2)), dble(f2), aimag(f2), dble(f3), aimag(f3)]
end subroutine func

subroutine stpnt(ndim, u, par, t)
  implicit none
  integer, intent(in) :: ndim
  double precision, intent(inout) :: u(ndim), par(*)
  double precision, intent(in) :: t
  ! straight motion, computed by bench.py
  include 'start.inc'
end subroutine stpnt

subroutine bcnd
end subroutine bcnd
subroutine icnd
end subroutine icnd
subroutine fopt
end subroutine fopt
subroutine pvls
end subroutine pvls
