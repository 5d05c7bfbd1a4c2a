//! The two small arrays everything is written in. Both live in the (r, z) plane plus the hoop direction θ;
//! in plane strain r reads x and θ the direction out of the plane.

use asperity_numerics::lanes::Real;

/// A symmetric tensor: components rr, zz, θθ, rz; of one point, or of several side by side.
pub type Sym<T = f64> = [T; 4];

/// A displacement gradient ∂u_i/∂x_j: components rr, rz, zr, zz, θθ.
pub type Gradient<T = f64> = [T; 5];

/// A quadratic form on gradients (symmetric).
pub type GradientForm<T = f64> = [[T; 5]; 5];

/// The form whose lower triangle is that of `form`, with the geometric term Σ g_iA τ_A g'_iA of the Kirchhoff
/// stress `tau` added.
#[inline(always)]
pub fn with_geometric_term<T: Real>(mut form: GradientForm<T>, tau: &Sym<T>) -> GradientForm<T> {
    for (i, j, component) in [(0, 0, 0), (1, 0, 3), (1, 1, 1), (2, 2, 0), (3, 2, 3), (3, 3, 1), (4, 4, 2)] {
        form[i][j] += tau[component];
    }
    for i in 0..5 {
        for j in i + 1..5 {
            form[i][j] = form[j][i];
        }
    }
    form
}

/// Trace of a symmetric tensor.
#[inline(always)]
pub fn trace<T: Real>(a: &Sym<T>) -> T {
    a[0] + a[1] + a[2]
}

/// Double contraction a : b.
#[inline(always)]
pub fn contract<T: Real>(a: &Sym<T>, b: &Sym<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] * 2.0
}

/// Von Mises equivalent √(3/2 s:s) of a symmetric tensor.
pub fn von_mises(a: &Sym) -> f64 {
    let m = trace(a) / 3.0;
    let s = [a[0] - m, a[1] - m, a[2] - m, a[3]];
    (1.5 * contract(&s, &s)).sqrt()
}

/// det(I + g) - 1, without the loss of digits of forming I + g.
#[inline(always)]
pub fn volume_change<T: Real>(g: &Gradient<T>) -> T {
    let plane = g[0] + g[3] + g[0] * g[3] - g[1] * g[2];
    plane + g[4] + plane * g[4]
}

/// f a fᵀ + (f fᵀ - I) with f = I + g: pushes a deviation from the identity (a = b - I) forward by f.
///
/// Far from the contact strains are 1e-9; only the deviations from the identity keep their digits there.
#[inline(always)]
pub fn push_forward<T: Real>(g: &Gradient<T>, a: &Sym<T>) -> Sym<T> {
    let [grr, grz, gzr, gzz, gtt] = *g;
    // f (I + a) fᵀ - I = a + p + pᵀ + p gᵀ with p = g (I + a)
    let (crr, czz, crz) = (a[0] + 1.0, a[1] + 1.0, a[3]);
    let (prr, prz) = (grr * crr + grz * crz, grr * crz + grz * czz);
    let (pzr, pzz) = (gzr * crr + gzz * crz, gzr * crz + gzz * czz);
    let hoop = gtt * 2.0 + gtt * gtt;
    [
        a[0] + prr * 2.0 + prr * grr + prz * grz,
        a[1] + pzz * 2.0 + pzr * gzr + pzz * gzz,
        a[2] + hoop + hoop * a[2],
        a[3] + prz + pzr + prr * gzr + prz * gzz,
    ]
}
