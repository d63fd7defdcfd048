#pragma once

// Azimuthal Fourier coefficients of the powers of the distance between two rings,
//     c_k^p = int_0^{2 pi} cos(k phi) / rho^p dphi,   rho^2 = a + b sin^2(phi/2),   p = 1, 3, 5,
// and what the kernels of Stokes flow need of them: those weighted by powers of sigma = sin^2(phi/2), and those with
// sin(phi) sin(k phi) in place of cos(k phi).
//
// Rings that are well apart: FFT of 1/rho^p. Near ones: rho^2 = (b/2)(chi - cos phi), so that c_k^1 is
// 4/sqrt(b) Q_{k-1/2}(chi), a toroidal harmonic, and with f_k^nu = int cos(k phi)/(chi - cos phi)^nu dphi
//     (k + 1 - nu) f_{k+1} = 2 k chi f_k - (k - 1 + nu) f_{k-1}
//     (chi^2 - 1) f_k^{nu+1} = chi (1 + k/nu) f_k^nu - ((k + 1)/nu - 1) f_{k+1}^nu
//     int sin(k phi) sin(phi)/(chi - cos phi)^{nu+1} dphi = (k/nu) f_k^nu
// (Young, Hao & Martinsson 2012 for the first). What is singular sits in chi - 1 = 2 a/b alone, which is an input: no
// digits are lost however close the rings are.

#include <array>
#include <memory>
#include <vector>

namespace endoflow::boundary_integral {

class AzimuthalIntegrals {
  public:
    /// For orders 0 ... highest.
    explicit AzimuthalIntegrals(int highest);
    ~AzimuthalIntegrals();
    AzimuthalIntegrals(const AzimuthalIntegrals&) = delete;
    AzimuthalIntegrals& operator=(const AzimuthalIntegrals&) = delete;

    /// `a` [nm^2] > 0: squared distance of the rings in the meridian plane; `b` = 4 r r0 [nm^2] >= 0.
    void evaluate(double a, double b);

    /// int sigma^j cos(k phi)/rho^p and int sigma^j sin(phi) sin(k phi)/rho^p; indices (p - 1)/2, j, k.
    [[nodiscard]] double cosine(std::size_t half_power, std::size_t j, std::size_t k) const {
        return cosine_[half_power][j][k];
    }
    [[nodiscard]] double sine(std::size_t half_power, std::size_t j, std::size_t k) const {
        return sine_[half_power][j][k];
    }

  private:
    struct Transform;
    using Orders = std::vector<double>;
    static constexpr std::size_t extra = 4;  // orders beyond the highest that weighting by sigma uses up

    std::size_t highest_;
    std::size_t count_;  // orders 0 ... highest + extra
    double well_apart_;  // smallest chi of rings that the FFT serves
    std::unique_ptr<Transform> transform_;
    std::array<std::array<Orders, 4>, 3> cosine_;  // [p][j][k], j <= p
    std::array<std::array<Orders, 3>, 3> sine_;

    void by_transform(double a, double b);
    void by_recurrence(double a, double b);
    void toroidal_harmonics(double a, double b, double chi_minus_one);
};

}  // namespace endoflow::boundary_integral
