// SPDX-License-Identifier: Apache-2.0
// The kernels of a CPU level: what they do over a whole batch, colour by colour.

template <class OnRow, class OnBall>
inline void each_row(const BulkBatch& batch, OnRow on_row, OnBall on_ball) {
  int row = 0, ball = 0;
  for (int c = 0; c < batch.colour_count; ++c) {
    for (; ball < batch.colours[c].balls_end; ++ball) on_ball(batch.balls[ball]);
    for (; row < batch.colours[c].rows_end; ++row) on_row(batch.rows[row]);
  }
}

void prepare(const BulkBatch& batch, const BulkContacts& contacts) {
  for (int r = 0; r < batch.row_count; ++r) prepare_row(batch, contacts, batch.rows[r]);
  for (int r = 0; r < batch.ball_count; ++r) prepare_ball(batch, contacts, batch.balls[r]);
}

void warm_start(const BulkBatch& batch) {
  each_row(
      batch, [&](const BulkRow& row) { warm_start_row(batch, row); },
      [&](const BulkBall& row) { warm_start_ball(batch, row); });
}

template <bool pressing>
void sweep(const BulkBatch& batch) {
  each_row(
      batch, [&](BulkRow& row) { sweep_row<pressing>(batch, row); },
      [&](BulkBall& row) { sweep_ball<pressing>(batch, row); });
}

// Contacts start each small step from the impulses of the last one. What these do to the bodies is
// known already, as what they did: no pass over the rows is needed.
inline V& four(double (&of)[8], int q) {
  return *reinterpret_cast<V*>(of + 4 * q);
}

void begin(const BulkBatch& batch) {
  for (int i = 0; i < batch.moving; ++i)
    for (int q = 0; q < 2; ++q) {
      BulkKick& k = batch.kicks[i];
      V* v = quad(batch.bodies, i, q);
      four(k.start, q) = *v;
      *v += four(k.kick, q) + four(k.push, q);
    }
}

void end(const BulkBatch& batch) {
  for (int i = 0; i < batch.moving; ++i)
    for (int q = 0; q < 2; ++q) {
      BulkKick& k = batch.kicks[i];
      four(k.push, q) = *quad(batch.bodies, i, q) - four(k.start, q) - four(k.kick, q);
    }
}

void move(const BulkBatch& batch, double h) {
  for (int i = 0; i < batch.moving; ++i)
    for (int q = 0; q < 2; ++q) {
      V* x = quad(batch.bodies, i, q + 2);
      *x = multiply_add(splat(h), *quad(batch.bodies, i, q), *x);
    }
}

double residual(const BulkBatch& batch) {
  V worst = splat(0);
  for (int r = 0; r < batch.row_count; ++r) worst = maximum(worst, unmet_row(batch, batch.rows[r]));
  for (int r = 0; r < batch.ball_count; ++r)
    worst = maximum(worst, unmet_ball(batch, batch.balls[r]));
  double most = 0;
  for (int i = 0; i < 4; ++i) most = worst[i] > most ? worst[i] : most;
  return most;
}

void write(const BulkBatch& batch, const BulkContacts& contacts) {
  for (int r = 0; r < batch.row_count; ++r) write_row(batch, contacts, batch.rows[r]);
  for (int r = 0; r < batch.ball_count; ++r) write_ball(batch, contacts, batch.balls[r]);
}

constexpr BulkKernels all_kernels = {prepare,      warm_start, begin,    sweep<true>, move,
                                     sweep<false>, end,        residual, write};
