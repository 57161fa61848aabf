// SPDX-License-Identifier: Apache-2.0
// The kernels of a CPU level: what they do over a share of a batch.

inline int begin_of(int n, BulkPart part) {
  return static_cast<int>(static_cast<long long>(n) * part.index / part.count);
}
inline int end_of(int n, BulkPart part) {
  return begin_of(n, {part.index + 1, part.count});
}

template <class OnRow, class OnBall>
inline void each_row(const BulkBatch& batch, const BulkColour& colour, BulkPart part, OnRow on_row,
                     OnBall on_ball) {
  if (colour.left_over) {  // rows that may share a body: one after the other
    if (part.index > 0) return;
    part = {};
  }
  const int balls = colour.balls_end - colour.balls_begin;
  const int rows = colour.rows_end - colour.rows_begin;
  for (int i = begin_of(balls, part); i < end_of(balls, part); ++i)
    on_ball(batch.balls[colour.balls_begin + i]);
  for (int i = begin_of(rows, part); i < end_of(rows, part); ++i)
    on_row(batch.rows[colour.rows_begin + i]);
}

void prepare(const BulkBatch& batch, const BulkContacts& contacts, BulkPart part) {
  for (int r = begin_of(batch.row_count, part); r < end_of(batch.row_count, part); ++r)
    prepare_row(batch, contacts, batch.rows[r]);
  for (int r = begin_of(batch.ball_count, part); r < end_of(batch.ball_count, part); ++r)
    prepare_ball(batch, contacts, batch.balls[r]);
}

void warm_start(const BulkBatch& batch, const BulkColour& colour, BulkPart part) {
  each_row(
      batch, colour, part, [&](const BulkRow& row) { warm_start_row(batch, row); },
      [&](const BulkBall& row) { warm_start_ball(batch, row); });
}

template <bool pressing>
void sweep(const BulkBatch& batch, const BulkColour& colour, BulkPart part) {
  each_row(
      batch, colour, part, [&](BulkRow& row) { sweep_row<pressing>(batch, row); },
      [&](BulkBall& row) { sweep_ball<pressing>(batch, row); });
}

// Contacts start each small step from the impulses they pressed with in the last one. What these do
// to the bodies is known already, as what they did: no pass over the rows is needed.
inline V& four(double (&of)[8], int q) {
  return *reinterpret_cast<V*>(of + 4 * q);
}

void begin(const BulkBatch& batch, BulkPart part) {
  for (int i = begin_of(batch.moving, part); i < end_of(batch.moving, part); ++i)
    for (int q = 0; q < 2; ++q) {
      BulkKick& k = batch.kicks[i];
      V* v = quad(batch.bodies, i, q);
      four(k.start, q) = *v;
      *v += four(k.kick, q) + four(k.push, q);
    }
}

void move(const BulkBatch& batch, double h, BulkPart part) {
  for (int i = begin_of(batch.moving, part); i < end_of(batch.moving, part); ++i)
    for (int q = 0; q < 2; ++q) {
      BulkKick& k = batch.kicks[i];
      const V v = *quad(batch.bodies, i, q);
      V* x = quad(batch.bodies, i, q + 2);
      four(k.push, q) = v - four(k.start, q) - four(k.kick, q);
      *x = multiply_add(splat(h), v, *x);
    }
}

double residual(const BulkBatch& batch, BulkPart part) {
  V worst = splat(0);
  for (int r = begin_of(batch.row_count, part); r < end_of(batch.row_count, part); ++r)
    worst = maximum(worst, unmet_row(batch, batch.rows[r]));
  for (int r = begin_of(batch.ball_count, part); r < end_of(batch.ball_count, part); ++r)
    worst = maximum(worst, unmet_ball(batch, batch.balls[r]));
  double most = 0;
  for (int i = 0; i < 4; ++i) most = worst[i] > most ? worst[i] : most;
  return most;
}

void write(const BulkBatch& batch, const BulkContacts& contacts, BulkPart part) {
  for (int r = begin_of(batch.row_count, part); r < end_of(batch.row_count, part); ++r)
    write_row(batch, contacts, batch.rows[r]);
  for (int r = begin_of(batch.ball_count, part); r < end_of(batch.ball_count, part); ++r)
    write_ball(batch, contacts, batch.balls[r]);
}

constexpr BulkKernels all_kernels = {prepare, warm_start,   begin,    sweep<true>,
                                     move,    sweep<false>, residual, write};
