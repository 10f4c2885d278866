//! Words that the pages define.

use motiform_figures::report::Definition;

/// All of them, in the order of the pages.
pub(crate) fn glossary() -> Vec<Definition> {
    WORDS.iter().map(|(word, text)| Definition::new(word, text)).collect()
}

const WORDS: &[(&str, &str)] = &[
    (
        "frames that count",
        "Frames whose outline is an observation of the shape: not clipped at the border, not self-crossing, not repeated, without a jump of the area, star-shaped about the centre. The flags of all others are listed.",
    ),
    (
        "rms speed",
        "Root mean square of the displacements from frame to frame over the sampling interval, with the part of the errors of the places, 4 sigma^2, subtracted.",
    ),
    (
        "path",
        "Sum of the displacements of the centroid from each frame that is seen to the next; straight across gaps.",
    ),
    (
        "directionality",
        "Net displacement over path. It falls with the length of the record: compare records of equal length.",
    ),
    (
        "turning cosine",
        "Mean cosine of the angle between displacements in a row: 1 straight on, 0 without memory, below 0 back. Errors of the places lower it.",
    ),
    (
        "persistence",
        "Persistence time P of the persistent random walk of highest likelihood through the places, with their errors as a third number (Kalman filter, whatever the gaps); its interval is that of the profile of the likelihood. Without an interval where innovations are not white: the cell is no such walk.",
    ),
    ("diffusion", "D = S^2 P/2 of the same walk: at late times the mean-square displacement is 4 D *t*."),
    (
        "place error",
        "Standard deviation of the error of a coordinate of the centroid, from the same fit: what does not last from one frame to the next.",
    ),
    ("aspect ratio", "Longer over shorter axis of the ellipse with the same second moments of the area."),
    ("solidity", "Area over that of the convex hull."),
    (
        "circularity",
        "4π area/perimeter^2: 1 for a circle. Outlines along the edges of pixels have longer perimeters: a disc of pixels 0.62.",
    ),
    (
        "stretch without gaps",
        "The longest run of frames that count at the sampling interval. The observed motion, its numbers and its name are those of this part of the record; the rest is not seen by them.",
    ),
    (
        "area step",
        "The area changes from one frame to the next and stays at the other level: another unit, or another cell under the same name. Such a record is not observed or fitted as one cell.",
    ),
    (
        "position jump",
        "The outline is at another place, 1.5 radii away or more, for at most three frames, and back within half of that distance. Such frames are left out; where they are more than a fifth, two cells have one name.",
    ),
    (
        "position step",
        "The centroid moves by more than 1.5 radii and by more than four times the 90 % quantile of all displacements, and stays: another cell under the same name.",
    ),
    (
        "mean radius",
        "R_0, the mean over frames of the constant part of R(θ) = R_0 + 2 Re(*z*_2 e^{2iθ}) + 2 Re(*z*_3 e^{3iθ}) + ..., the distance of the outline from the centre in the direction θ. The centre is the point about which there is no first harmonic; it is not the centroid.",
    ),
    (
        "speed",
        "Mean length of the displacements over the step, divided by its duration. The step is the least number of frames over which 95 % of the displacements are 5 times their error.",
    ),
    (
        "scatter of the speed",
        "Standard deviation of the speed relative to its mean, the part of the measurement errors subtracted.",
    ),
    (
        "turning rate",
        "Mean rate of change of the heading, the direction of the displacements; positive anticlockwise in the coordinates of the data. Its error is that of the mean of eight blocks of the record.",
    ),
    ("directness", "Net displacement divided by the length of the path."),
    ("sampling interval", "Time between frames: the median."),
    (
        "persistence time",
        "P of the persistent random walk <r^2>(*t*) = 2 S^2 P (*t* - P (1 - e^{-*t*/P})), fitted to the mean-square displacement; in brackets the 95 % interval. Not given where the walk does not describe the displacements, or the record is too short to see it. Fürth (1920).",
    ),
    (
        "diffusion coefficient",
        "D = S^2 P/2 of the same fit: at late times the mean-square displacement is 4 D *t*.",
    ),
    (
        "correlation time of velocity",
        "Integral of the autocorrelation of the velocity over the lag, up to the lag at which it is 16 times the integral of the squared autocorrelation.",
    ),
    ("correlation time of *z*_2", "The same for *z*_2."),
    ("correlation time of *z*_3", "The same for *z*_3."),
    (
        "peaks of the spectrum of speed",
        "Frequencies at which the power spectral density (Welch's method: Hann windows of half the record that overlap by half, means subtracted) has a maximum above 7 times the median power from half that frequency to twice; at most three. The share is that of the variance within two spacings of the frequencies. Noise, also with memory, has such a peak in fewer than 5 % of spectra.",
    ),
    ("peaks of the spectrum of |*z*_2|", "The same for the size of the elongation."),
    (
        "peaks of the spectrum of *z*_2 across",
        "The same for the imaginary part of *z*_2 e^{2iφ}, φ the heading: the elongation at 45 degrees to the motion, which the mirror reverses. Its frequency is that of a zigzag; speed and |*z*_2| have twice that.",
    ),
    (
        "rests",
        "Stretches of at least a step in which the speed is below a quarter of its 95 % quantile (or below three of its errors, if that is more). Stretches that are cut by the ends of the record are left out; the share of the time has them.",
    ),
    (
        "legs",
        "The unwrapped heading turns back and forth; between two of its extremes, more than 0.3 rad (and four errors of the heading) apart, is a corner, where the heading is half-way. A leg is the path between two corners, its length that of the chord. A path that bends to one side alone has no legs.",
    ),
    (
        "turns of the heading",
        "Last minus first unwrapped heading, in full turns; positive anticlockwise in the coordinates of the data.",
    ),
    (
        "turns of the shape",
        "The same for the long axis: minus half the unwrapped argument of *z*_2, where it is above three of its errors in 95 % of the frames.",
    ),
    (
        "0-1 test",
        "*K* of Gottwald and Melbourne for *z*_2 across, sampled at the first lag at which its autocorrelation is not positive; in brackets the quartiles over 100 frequencies. Near 0: regular, with little noise. Near 1: chaos or noise, which samples do not tell apart. At least 200 samples are needed.",
    ),
    (
        "observed motion",
        "The motion as the samples alone show it: straight, circular, zigzag, quasi-periodic or motionless, where the record leaves no other; otherwise undecided. Chaos cannot be told from noise by samples.",
    ),
    (
        "motion of the fit",
        "The motion of the fitted equations without their noise: 40 models are drawn from the estimate and classified; 90 % must agree, with the best model among them.",
    ),
    (
        "symmetry",
        "Mirror symmetric: all coefficients are real. p is the p-value of a likelihood-ratio test of real against complex coefficients. Handed: p below 0.0001, so that one mirror-symmetric cell in ten thousand is called handed by chance. Mirror symmetric: p above 0.01, and the 95 % intervals of all imaginary parts exclude 10 % of the largest coefficient of their equation, in natural units; a large p alone is no evidence of symmetry. Otherwise not decidable.",
    ),
    (
        "error between cells",
        "Of one law for all cells: the standard error from the differences between cells (infinitesimal jackknife over whole cells). It also holds where cells differ; the error beside the coefficient holds where all follow the same law.",
    ),
    (
        "term",
        "A product of amplitudes that rotations allow, and the equation in which it stands: z1 is the velocity v_x - i v_y, z2 the elongation, z3 the triangle; z\\* is the complex conjugate.",
    ),
    (
        "coefficient",
        "Maximum-likelihood estimate through an extended Kalman filter, in units of the data, ± its standard error from the expected information.",
    ),
    (
        "robust error",
        "Standard error from the scatter of the scores (sandwich). Larger than the other one where the noise is not white or not the same throughout.",
    ),
    (
        "95 % interval",
        "Of an estimate: estimate ∓ 1.96 standard errors. Of a mean over cells: from whole cells drawn with replacement.",
    ),
    (
        "95 % interval of the share",
        "Wilson (1927), J. Am. Stat. Assoc. 22, 209: the shares of all such cells with which the counted number agrees.",
    ),
    ("parameter of the study file", "The same number by the paper's name, with the paper's factor."),
    (
        "largest change",
        "The largest difference between the fit of all frames and that of every second or fourth, in standard deviations of such a difference: above 3.5 there is a warning. Hausman (1978), Econometrica 46, 1251.",
    ),
    (
        "weak form",
        "The coefficient by least squares: the equations, multiplied by test functions that vanish at the ends of windows of three natural times and integrated by parts, so that no noisy data are differentiated. Biased under process noise. Messenger and Bortz (2021), Multiscale Model. Simul. 19, 1474.",
    ),
    (
        "innovations of",
        "Innovation: what a frame shows beyond what the filter predicted from the frames before, divided by its predicted standard deviation; of each number what it adds to those before it in the list x, y, Re z2, Im z2, ... If the model is right they are independent with variance 1.",
    ),
    (
        "p of white noise",
        "Probability of autocorrelations as large as these, at lags of one to ten frames, in white noise. Ljung and Box (1978), Biometrika 65, 297.",
    ),
    ("log-likelihood", "Natural logarithm of the probability density of all observations, at its maximum."),
    (
        "frames with a likelihood",
        "Frames that the filter predicts: all but the first of each stretch without long gaps.",
    ),
    (
        "factor of the stated errors",
        "s: the errors of the outlines are s times those that their residuals say.",
    ),
    (
        "noise of the velocity",
        "Amplitude of white noise on each component of the velocity: without the equations its variance would grow by the square of this number per unit of time.",
    ),
    (
        "noise of the shape",
        "The same for the real and imaginary parts of *z*_2, *z*_3 and, in models that have it, *z*_4.",
    ),
    (
        "sets of terms that are as good",
        "Number of sets of terms whose score, -2 ln L + ln(6 N) for each coefficient (8 N with z4), lies within 6 of the best one. The data do not tell them apart.",
    ),
    ("natural time", "T: the inverse root-mean-square rate of change of the shape."),
    (
        "determined",
        "Combinations of the coefficients with independent errors (eigenvectors of their covariance) that the motion fixes, and those that it leaves free.",
    ),
    (
        "warnings",
        "What makes the fit doubtful: sampling too coarse for the filter, unbounded coefficients, noise at a bound, coloured residuals, coefficients that depend on the sampling interval.",
    ),
    (
        "place",
        "The fitted equations in units of time, speed and shape that leave two coordinates of a plane of the paper. Not given where the data do not determine it, where a unit is not defined, or for handed cells.",
    ),
    (
        "value on the slice",
        "The paper's planes are slices through the space of all parameters: this is the value that the parameter has there.",
    ),
    (
        "simulated cells",
        "How many statistics of the cell agree with those of cells simulated by equations drawn from its estimate, with their noise. Unstable: more than a tenth of the simulated cells leave all bounds.",
    ),
    ("verdict", "Agrees: p above 0.05. Doubtful: 0.01 to 0.05. Differs: p up to 0.01."),
    (
        "p-value",
        "Share of the simulated and the observed curves that are at least as far from the mean of all as the observed one: u = max |T - m|/s over all points of the curve, with mean m and standard deviation s over all curves. If the cell were one of the simulated ones, p would be below a with probability a. The model was fitted to the same cell, so agreement is somewhat more frequent. Myllymäki et al. (2017), J. R. Stat. Soc. B 79, 381.",
    ),
    (
        "farthest off",
        "The point of the curve where the observed one is farthest from the mean, in standard deviations of the simulated ones.",
    ),
    ("mean-square displacement", "Mean over all times *t* of |r(*t* + lag) - r(*t*)|^2."),
    ("autocorrelation of the velocity", "<v(*t*) · v(*t* + lag)>/<v^2>, v by displacements over the step."),
    ("autocorrelation of z2", "Re <conj(*z*_2(*t*)) *z*_2(*t* + lag)>/<|*z*_2|^2>."),
    ("autocorrelation of z3", "The same for *z*_3."),
    (
        "elongation along the motion",
        "<Re *z*_2(*t* + lag) e^{2iφ(*t*)}>/<|*z*_2|> with the heading φ: 1 for a body elongated along its motion, -1 across it. Negative lags: the shape before the motion.",
    ),
    (
        "turning angle",
        "Angle between displacements over the step that follow one another, positive anticlockwise: quantiles.",
    ),
    ("size of z2", "|*z*_2|: quantiles. Along its axis the body is longer by 4 |*z*_2| than across it."),
    ("size of z3", "|*z*_3|: quantiles."),
    ("autocorrelation of z4", "The same as of z2 and z3, for the square mode *z*_4, in models that have it."),
    ("size of z4", "|*z*_4|: quantiles, in models that have it."),
];
