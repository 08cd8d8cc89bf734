#pragma once
// The exposure of a walk: fixed, or following what is seen as an eye does.

namespace vlf {

/// All values in EV.
class Exposure {
  public:
    /// Fixed at `start`.
    explicit Exposure(float start) : base_(start) {}

    float value() const { return base_ + compensation_; }

    bool automatic() const { return automatic_; }
    /// Stopping leaves it where it is.
    void setAutomatic(bool on) { automatic_ = on; }

    /// What the user adds.
    float compensation() const { return compensation_; }
    void setCompensation(float ev) { compensation_ = ev; }

    /// While automatic, comes nearer to `wanted`, the exposure that suits what is seen.
    void adapt(float wanted, float seconds);

  private:
    float base_;
    float compensation_ = 0;
    bool automatic_ = false;
};

}  // namespace vlf
