(** * The symplectic conjugate and the symplectic pair

    The conjugate is recognised without division: Â^{l,m} is the block for which
    b_l(x ⊙ Â^{l,m} y) + b_m(A^{m,l} x ⊙ y) = b_l(x) b_m(y) for all stage values x and y; at points
    this is b_i b_j = b_i â_ij + b_j a_ji. *)

From Coq Require Import QArith ZArith List Arith Lia Bool.
From Gark Require Import Stages Trees Methods Sums Check.
Import ListNotations.
Open Scope Q_scope.

Section Conjugate.
Variable M C : method.

(** The coefficient of θ^e in b_l(x) b_m(y). *)
Definition both l m e (x y : V) : Q := times M (fun u => b M l u x) (fun v => b M m v y) e.

Definition defect l m e (x y : V) : Q :=
  b M l e (mul (Pof M l) x (app (Aof C l m) y)) + b M m e (mul (Pof M m) (app (Aof M m l) x) y)
  - both l m e x y.

Definition is_conjugate :=
  field C = field M /\ spaces C = spaces M /\ colours C = colours M /\
  forall l m, (l < N M)%nat -> (m < N M)%nat ->
    (sees C l m <-> sees M m l) /\
    (sees M m l -> forall e x y, (e < degree M)%nat -> defect l m e x y == 0).

(** Positions are driven by the blocks of the method, momenta by those of its conjugate. *)
Definition pair_of : method := {|
  field := field M; spaces := spaces M; colours := colours M ++ colours M;
  blocks := map (fun '(r, s) => r ++ s) (combine (blocks M) (blocks C)) |}.

(** ** Values at units decide bilinear identities *)

Definition zunit (i : nat) : zvec := (repeat 0%Z i ++ [1%Z], 1%positive).
Definition unit i := val (zunit i).

Lemma zunit_at i j : nth j (fst (zunit i)) 0%Z = if Nat.eqb j i then 1%Z else 0%Z.
Proof.
  simpl. destruct (Nat.eqb_spec j i) as [->|H].
  - rewrite app_nth2, repeat_length, Nat.sub_diag by (rewrite repeat_length; lia). reflexivity.
  - destruct (lt_dec j i) as [L|L].
    + rewrite app_nth1 by (rewrite repeat_length; lia). apply nth_repeat.
    + rewrite nth_overflow; [reflexivity|]. rewrite app_length, repeat_length. simpl. lia.
Qed.
Lemma unit_at i j : unit i j == if Nat.eqb j i then 1 else 0.
Proof. unfold unit, val. rewrite zunit_at. destruct (Nat.eqb j i); reflexivity. Qed.

Fixpoint cut n (x : V) : V :=
  match n with O => fun _ => 0 | S n => add (cut n x) (scale (x n) (unit n)) end.

Lemma cut_at n x j : cut n x j == if Nat.ltb j n then x j else 0.
Proof.
  induction n; [reflexivity|]. cbn [cut]. unfold add, scale. rewrite IHn, unit_at.
  destruct (Nat.eqb_spec j n) as [->|H].
  - rewrite Nat.ltb_irrefl. replace (Nat.ltb n (S n)) with true by (symmetry; apply Nat.ltb_lt;
    lia). ring.
  - replace (Nat.ltb j (S n)) with (Nat.ltb j n); [destruct (Nat.ltb j n); ring|].
    apply eq_true_iff_eq. rewrite !Nat.ltb_lt. lia.
Qed.

Lemma zero_on_units n f : linear f -> local n f -> (forall i, (i < n)%nat -> f (unit i) == 0) ->
  forall x, f x == 0.
Proof.
  intros L Lo H x. rewrite (Lo x (cut n x)).
  - clear Lo. induction n; simpl.
    + rewrite (l_ext _ L _ (scale 0 (fun _ => 0))); [rewrite (l_scale _ L); ring|].
      intros i. unfold scale. ring.
    + rewrite (l_add _ L), (l_scale _ L), (H n) by lia. rewrite IHn; [ring|].
      intros i Hi. apply H. lia.
  - intros j Hj. rewrite cut_at. apply Nat.ltb_lt in Hj. rewrite Hj. reflexivity.
Qed.

Lemma linear_plus f g : linear f -> linear g -> linear (fun x => f x + g x).
Proof.
  intros [A B D] [A' B' D']. split; intros.
  - rewrite (A x y H), (A' x y H). reflexivity.
  - rewrite B, B'. ring.
  - rewrite D, D'. ring.
Qed.
Lemma linear_times c f : linear f -> linear (fun x => c * f x).
Proof.
  intros [A B D]. split; intros.
  - rewrite (A x y H). reflexivity.
  - rewrite B. ring.
  - rewrite D. ring.
Qed.
Lemma linear_ext f g : (forall x, f x == g x) -> linear f -> linear g.
Proof.
  intros E [A B D]. split; intros; rewrite <- !E; auto.
Qed.
Lemma linear_sum {X} (xs : list X) (f : X -> V -> Q) : (forall x, linear (f x)) ->
  linear (fun v => fold_right Qplus 0 (map (fun x => f x v) xs)).
Proof.
  intros H. induction xs as [|a xs IH]; simpl; [split; intros; ring|].
  apply linear_plus; [apply H|apply IH].
Qed.

Lemma b_linear l e : linear (b M l e).
Proof. apply lin_linear. Qed.

Lemma both_left l m e y : linear (fun x => both l m e x y).
Proof.
  unfold both, times. cbv zeta. apply (linear_sum (seq 0 (degree M))). intros u.
  apply (linear_sum (seq 0 (degree M))). intros v.
  apply linear_ext with (f := fun x => in_field M e u v * b M m v y * b M l u x); [intros; ring|].
  apply linear_times, b_linear.
Qed.
Lemma both_right l m e x : linear (both l m e x).
Proof.
  unfold both, times. cbv zeta. apply (linear_sum (seq 0 (degree M))). intros u.
  apply (linear_sum (seq 0 (degree M))). intros v. apply linear_times, b_linear.
Qed.

Lemma defect_left l m e y : linear (fun x => defect l m e x y).
Proof.
  unfold defect, Qminus. apply linear_plus; [apply linear_plus|].
  - apply (mul_left (b M l e)), b_linear.
  - apply (app_linear (fun z => b M m e (mul (Pof M m) z y))), mul_left, b_linear.
  - apply linear_ext with (f := fun x => (-(1)) * both l m e x y); [intros; ring|].
    apply linear_times, both_left.
Qed.
Lemma defect_right l m e x : linear (defect l m e x).
Proof.
  unfold defect, Qminus. apply linear_plus; [apply linear_plus|].
  - apply (app_linear (fun z => b M l e (mul (Pof M l) x z))), mul_right, b_linear.
  - apply (mul_right (b M m e)), b_linear.
  - apply linear_ext with (f := fun y => (-(1)) * both l m e x y); [intros; ring|].
    apply linear_times, both_right.
Qed.

(** Rows are no longer than there are stages. *)
Definition row_fits (l : nat) (row : list number) := Nat.leb (length row) (size_of (space_at M l)).
Definition fits : bool :=
  all (N M) (fun l => row_fits l (snd (nth l (colours M) (O, [])))
    && all (N M) (fun m => forallb (row_fits m) (the_block M l m)
                           && forallb (row_fits m) (the_block C l m))).

(** ** The checker *)

Definition vanishes (u v w : zvec) : bool :=
  all (degree M) (fun e => Qeq_bool (val u e + val v e - val w e) 0).

(** The defect of a block at all units; F multiplies numbers. *)
Definition block_is_conjugate (T T' : zmaps) (F : zvec -> zvec -> zvec) l m : bool :=
  let xs := table (dim M l) (fun i =>
    (zunit i, Az T m l (zunit i), Wz T l (zunit i))) in
  let ys := table (dim M m) (fun j =>
    (zunit j, Az T' l m (zunit j), Wz T m (zunit j))) in
  forallb (fun '(x, Ax, bx) => forallb (fun '(y, Ay, by_) =>
    vanishes (Wz T l (Pz T l x Ay)) (Wz T m (Pz T m Ax y)) (F bx by_)) ys) xs.

Definition conjugate_is_proved : bool :=
  let T := the_maps M in let T' := the_maps C in let F := ztimes_of M in
  fits &&
  all (N M) (fun l => all (N M) (fun m =>
    eqb (is_seen C l m) (is_seen M m l) &&
    (negb (is_seen M m l) || block_is_conjugate T T' F l m))).

Hypothesis same_field : field C = field M.
Hypothesis same_spaces : spaces C = spaces M.
Hypothesis same_colours : colours C = colours M.
Hypothesis proved : conjugate_is_proved = true.

Lemma both_val l m e i j : (l < N M)%nat -> (m < N M)%nat -> (e < degree M)%nat ->
  both l m e (unit i) (unit j) ==
  val (ztimes_of M (Wz (the_maps M) l (zunit i)) (Wz (the_maps M) m (zunit j))) e.
Proof.
  intros Hl Hm He. rewrite ztimes_of_val by exact He. apply times_ext; intros u Hu;
    apply (b_val M _ eq_refl); assumption.
Qed.

Lemma unit_defect_is_0 l m e i j : (l < N M)%nat -> (m < N M)%nat -> (e < degree M)%nat ->
  (i < dim M l)%nat -> (j < dim M m)%nat ->
  block_is_conjugate (the_maps M) (the_maps C) (ztimes_of M) l m = true ->
  defect l m e (unit i) (unit j) == 0.
Proof.
  intros Hl Hm He Hi Hj K. unfold block_is_conjugate in K. cbv zeta in K.
  rewrite forallb_forall in K. specialize (K _ (in_map _ _ i (proj2 (in_seq (dim M l) 0 i)
    ltac:(lia)))).
  cbv beta iota in K. rewrite forallb_forall in K.
  specialize (K _ (in_map _ _ j (proj2 (in_seq (dim M m) 0 j) ltac:(lia)))). cbv beta iota in K.
  pose proof (all_at _ _ K e He) as E. apply Qeq_bool_iff in E.
  assert (Hl' : (l < N C)%nat) by (unfold N; rewrite same_colours; exact Hl).
  assert (Hm' : (m < N C)%nat) by (unfold N; rewrite same_colours; exact Hm).
  rewrite <- E. unfold defect. rewrite both_val by assumption.
  apply Qplus_comp; [apply Qplus_comp|reflexivity].
  - rewrite <- (b_val M _ eq_refl) by assumption. apply (l_ext _ (b_linear l e)). intros k.
  symmetry.
    revert k. eapply veq_trans; [apply (P_val M _ eq_refl), Hl|]. apply mul_ext; [apply veq_refl|].
    apply (A_val C _ eq_refl); assumption.
  - rewrite <- (b_val M _ eq_refl) by assumption. apply (l_ext _ (b_linear m e)). intros k.
  symmetry.
    revert k. eapply veq_trans; [apply (P_val M _ eq_refl), Hm|]. apply mul_ext; [|apply veq_refl].
    apply (A_val M _ eq_refl); assumption.
Qed.

Lemma fits_is : fits = true -> forall l m, (l < N M)%nat -> (m < N M)%nat ->
  (forall e, local (dim M l) (b M l e)) /\
  (forall i, local (dim M m) (fun x => app (Aof M l m) x i)) /\
  (forall i, local (dim M m) (fun x => app (Aof C l m) x i)).
Proof.
  intros H l m Hl Hm. pose proof (all_at _ _ H l Hl) as K. cbv beta in K.
  apply andb_prop in K. destruct K as [W K]. pose proof (all_at _ _ K m Hm) as A. cbv beta in A.
  apply andb_prop in A. destruct A as [A A']. rewrite forallb_forall in A, A'.
  assert (E : dim M m = dim C m /\ space_at C m = space_at M m).
  { unfold dim, space_at, the_space, space_of, degree. rewrite same_field, same_spaces, same_colours.
    split; reflexivity. }
  split; [|split].
  - intros e. apply row_local. unfold dim. apply Nat.mul_le_mono_r, Nat.leb_le, W.
  - intros i. apply A_local. intros B EB row R. apply Nat.leb_le, A. unfold the_block.
    rewrite EB. exact R.
  - intros i. destruct E as [-> E]. apply A_local. intros B EB row R. rewrite E.
    apply Nat.leb_le, A'. unfold the_block. rewrite EB. exact R.
Qed.

Theorem proved_conjugate : is_conjugate.
Proof.
  split; [exact same_field|]. split; [exact same_spaces|]. split; [exact same_colours|].
  pose proof proved as H. unfold conjugate_is_proved in H. cbv zeta in H.
  apply andb_prop in H. destruct H as [Fit D].
  intros l m Hl Hm. pose proof (all_at _ _ (all_at _ _ D l Hl) m Hm) as K. cbv beta in K.
  apply andb_prop in K. destruct K as [Se K]. apply eqb_prop in Se.
  split; [rewrite !seen_iff, Se; reflexivity|].
  intros Hs e x y He. rewrite seen_iff in Hs. rewrite Hs in K. cbn [negb orb] in K.
  destruct (fits_is Fit l m Hl Hm) as [Bl [_ Al]]. destruct (fits_is Fit m l Hm Hl) as [Bm [Am _]].
  apply (zero_on_units (dim M l) (fun x => defect l m e x y)).
  - apply defect_left.
  - intros z w E. unfold defect, both.
    rewrite (l_ext _ (b_linear l e) _ _ (mu_below M l z w _ _ E (fun _ _ => Qeq_refl _))).
    rewrite (l_ext _ (b_linear m e) _ _ (mul_ext (Pof M m) _ _ y y
      (fun i => Am i z w E) (veq_refl y))).
    rewrite (times_ext M _ _ _ _ e (fun u _ => Bl u z w E) (fun _ _ => Qeq_refl _)). reflexivity.
  - intros i Hi. apply (zero_on_units (dim M m) (defect l m e (unit i))).
    + apply defect_right.
    + intros z w E. unfold defect, both.
      rewrite (l_ext _ (b_linear l e) _ _ (mul_ext (Pof M l) _ _ _ _ (veq_refl _)
        (fun i => Al i z w E))).
      rewrite (l_ext _ (b_linear m e) _ _ (mu_below M m _ _ z w (fun _ _ => Qeq_refl _) E)).
      rewrite (times_ext M _ _ _ _ e (fun _ _ => Qeq_refl _) (fun v _ => Bm v z w E)). reflexivity.
    + intros j Hj. apply unit_defect_is_0; assumption.
Qed.
End Conjugate.
