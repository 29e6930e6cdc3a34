#pragma once

namespace goalmouth {

/// An edge that stands more or less upright in the picture: x = a + b·y [px].
struct UprightLine {
    double a = 0.0;
    double b = 0.0;
    double at(double y) const { return a + b * y; }
};

/// Its least-squares fit to points, which come one by one.
class UprightFit {
  public:
    void add(double x, double y) {
        n_ += 1.0;
        x_ += x;
        y_ += y;
        xy_ += x * y;
        yy_ += y * y;
    }
    double points() const { return n_; }
    /// Requires a point; upright where all lie in one row.
    UprightLine line() const {
        const double spread = n_ * yy_ - y_ * y_;
        const double b = spread > 0.0 ? (n_ * xy_ - x_ * y_) / spread : 0.0;
        return {(x_ - b * y_) / n_, b};
    }

  private:
    double n_ = 0.0, x_ = 0.0, y_ = 0.0, xy_ = 0.0, yy_ = 0.0;
};

}  // namespace goalmouth
