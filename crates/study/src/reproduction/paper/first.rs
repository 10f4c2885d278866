//! Abstract, introduction, and the section that sets up both models.

use super::{Entry, checked, not};

const OUTLOOK: &str = "says what the paper is about; what it finds is checked where it is found";
const BACKGROUND: &str = "background with references to other work; no result of this paper";
const EXPERIMENT: &str = "about experiments, which no computation here can check";
const DEFINITION: &str = "a definition; the claims use it";

pub(super) const ABSTRACT: &[Entry] = &[
    not(
        1,
        3,
        "We investigate the dynamical coupling between motion and deformation in two model systems.",
        OUTLOOK,
    ),
    checked(
        4,
        4,
        "Numerical simulations show a rich variety of dynamics, some of which are common to the two model systems.",
        &["models"],
    ),
    not(5, 5, "The origin of the similarity and the difference is discussed.", OUTLOOK),
];

pub(super) const INTRODUCTION: &[Entry] = &[
    not(
        6,
        12,
        "Self-propelled objects; swimming at low Reynolds number; domains that move by broken symmetry.",
        BACKGROUND,
    ),
    not(13, 16, "Droplets, vesicles, synthetic systems, amoebas and fibroblasts.", EXPERIMENT),
    not(
        17,
        20,
        "Two classes: deformation induced by migration, and motion induced by deformation.",
        BACKGROUND,
    ),
    not(21, 23, "We consider two model systems; the tensor model follows from symmetry alone.", OUTLOOK),
    checked(
        24,
        24,
        "We shall show that this model is applied, by changing the parameters, to both the deformation-induced motion and the motion-induced deformation.",
        &["equations"],
    ),
    not(
        25,
        28,
        "The other model is an equation for a closed loop; we explore universal and non-universal behaviors.",
        OUTLOOK,
    ),
];

pub(super) const MODELS: &[Entry] = &[
    not(
        29,
        30,
        "We introduce two model systems; one is based on an excited domain in reaction-diffusion systems.",
        BACKGROUND,
    ),
    not(
        31,
        32,
        "*R*(*θ*) = *R*_0 + *δR*(*θ*, *t*), *δR* = Σ *z_n* e^{i*nθ*}, without the modes ±1.",
        DEFINITION,
    ),
    checked(33, 33, "The modes *z*_{±2} represent an elliptical shape of the domain.", &["equations"]),
    checked(34, 35, "The tensors *S* and *U* in terms of the modes *z*_{±2} and *z*_{±3}.", &["equations"]),
    checked(
        36,
        37,
        "The equations of *v*, *S* and *U* are derived by considering the possible couplings, up to the third order.",
        &["equations"],
    ),
    not(
        38,
        40,
        "Parts of these equations were derived and studied before; we call them the tensor model.",
        BACKGROUND,
    ),
    checked(
        41,
        41,
        "Propagation occurs from the first and second terms of the equation of *v* for *γ* > 0.",
        &["equations"],
    ),
    checked(
        42,
        43,
        "The domain is deformed as the velocity is increased, even when *κ*_2 and *κ*_3 are positive: a motion-induced deformation.",
        &["equations"],
    ),
    checked(
        44,
        45,
        "When *κ*_2 and *κ*_3 are negative the domain is deformed and drifts by the couplings *SU* and *SUU*: a deformation-induced motion.",
        &["equations"],
    ),
    not(
        46,
        48,
        "The boundary **X**(*s*), its tangent, its curvature, and *φ*(*s*) in the normal angle.",
        DEFINITION,
    ),
    not(
        49,
        49,
        "We assume that *φ* is sufficiently small.",
        "an assumption; how small *φ* is stands in Fig. 6's claims on closing the boundary",
    ),
    checked(
        50,
        51,
        "The dynamics of *φ* should be invariant against (i) *φ* → *φ* + *φ*_0, (ii) *s* → *s* + *s*_0, (iii) *s* → −*s*, *φ* → −*φ*.",
        &["equations"],
    ),
    checked(
        52,
        52,
        "Keeping these in mind, we write down the equation up to bilinear order, with *g*_1 to *g*_5.",
        &["equations"],
    ),
    not(
        53,
        53,
        "We assume no instability in the long wave length limit, so that *g*_1 is non-negative.",
        "an assumption; what *g*_1 > 0 does is checked with sentence 55",
    ),
    checked(
        54,
        54,
        "*g*_2 > 0 makes the circle unstable, *g*_3 > 0 recovers the stability at short waves.",
        &["equations"],
    ),
    checked(
        55,
        55,
        "Under this condition the term with *g*_1 is expected to be irrelevant and can be ignored.",
        &["equations"],
    ),
    checked(56, 56, "The term with *g*_4 can be written in a variational form.", &["equations"]),
    checked(
        57,
        57,
        "To make the potential bounded below, we need to add ∫ d*s* (∂_s *φ*)^4.",
        &["equations"],
    ),
    checked(
        58,
        58,
        "Therefore this nonlinearity does not cause any asymptotic complex dynamics such as domain oscillation.",
        &["equations"],
    ),
    checked(59, 59, "The last term is not variational.", &["equations"]),
    checked(
        60,
        62,
        "The minimal equation: coefficients are eliminated, the sign is chosen without loss of generality, only *L* is left.",
        &["equations"],
    ),
    not(63, 63, "In a previous paper the equation was derived from a free energy functional.", BACKGROUND),
    not(
        64,
        70,
        "The shape follows from *φ*; its velocity needs a condition: **v** = (1/*L*) ∫ d*s* *Y*(*κ*) **n**, expanded in *κ*.",
        DEFINITION,
    ),
    checked(71, 72, "The lowest order term vanishes because the boundary is closed.", &["equations"]),
    checked(73, 73, "The first order term also vanishes identically.", &["equations"]),
    checked(
        74,
        74,
        "As a result, the velocity is given by the integrals over (∂_s *φ*)^2 and (∂_s^2 *φ*)^2.",
        &["equations"],
    ),
    not(
        75,
        77,
        "The terms with *α*_2 and *α*_3 correspond to *g*_4 and *g*_5; only *α*_3 is kept.",
        "a choice of the model, by analogy; nothing is claimed of its motions",
    ),
];
