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
    void add(double x, double y) { count(x, y, 1.0); }
    /// Of a point that was added. Leaves nothing of it where x is of single precision and y whole: such sums
    /// are exact.
    void take_away(double x, double y) { count(x, y, -1.0); }
    double points() const { return n_; }
    /// Requires a point; upright where all lie in one row.
    UprightLine line() const {
        const double spread = n_ * yy_ - y_ * y_;
        const double b = spread > 0.0 ? (n_ * xy_ - x_ * y_) / spread : 0.0;
        return {(x_ - b * y_) / n_, b};
    }

  private:
    void count(double x, double y, double times) {
        n_ += times;
        x_ += times * x;
        y_ += times * y;
        xy_ += times * (x * y);
        yy_ += times * (y * y);
    }

    double n_ = 0.0, x_ = 0.0, y_ = 0.0, xy_ = 0.0, yy_ = 0.0;
};

}  // namespace goalmouth
