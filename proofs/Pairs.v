(** * The symplectic conjugate and the symplectic pair

    The conjugate is recognised without division: Â^{l,m} is the block for which
    b_l(x ⊙ Â^{l,m} y) + b_m(A^{m,l} x ⊙ y) = b_l(x) b_m(y) for all stage values x and y; at points
    this is b_i b_j = b_i â_ij + b_j a_ji. *)

From Coq Require Import QArith ZArith List Arith Lia Bool.
From Gark Require Import Stages Trees Methods Tables Check.
Import ListNotations.
Open Scope Q_scope.

Section Conjugate.
Variable M C : method.

(** The coefficient of θ^e in b_l(x) b_m(y). *)
Definition both l m e (x y : V) : Q :=
  fold_right Qplus 0 (map (fun p => in_field M e (fst p) (snd p) * (b M l (fst p) x * b M m (snd
    p) y))
    (list_prod (seq 0 (degree M)) (seq 0 (degree M)))).

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

Definition local n (f : V -> Q) := forall x y, (forall j, (j < n)%nat -> x j == y j) -> f x == f y.

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
  apply (linear_sum _ (fun p x => in_field M e (fst p) (snd p) * (b M l (fst p) x * b M m (snd p)
    y))).
  intros p. apply linear_times.
  apply linear_ext with (f := fun x => b M m (snd p) y * b M l (fst p) x); [intros; ring|].
  apply linear_times, b_linear.
Qed.
Lemma both_right l m e x : linear (both l m e x).
Proof.
  apply (linear_sum _ (fun p y => in_field M e (fst p) (snd p) * (b M l (fst p) x * b M m (snd p)
    y))).
  intros p. apply linear_times, linear_times, b_linear.
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

(** All entries that these maps look at are below a bound. *)
Definition lin_below n (ts : list (nat * Q)) := forallb (fun t => Nat.ltb (fst t) n) ts.
Definition bil_below n n' (ts : list (nat * nat * Q)) :=
  forallb (fun t => Nat.ltb (fst (fst t)) n && Nat.ltb (snd (fst t)) n') ts.

Lemma lin_local n ts : lin_below n ts = true -> local n (lin ts).
Proof.
  intros H x y E. induction ts as [|[j q] r IH]; simpl in *; [reflexivity|].
  apply andb_prop in H. destruct H as [H K]. apply Nat.ltb_lt in H.
  rewrite (E j H), (IH K). reflexivity.
Qed.
Lemma bil_local n n' ts x y x' y' : bil_below n n' ts = true ->
  (forall j, (j < n)%nat -> x j == x' j) -> (forall j, (j < n')%nat -> y j == y' j) ->
  bil ts x y == bil ts x' y'.
Proof.
  intros H E E'. induction ts as [|[[a c] q] r IH]; simpl in *; [reflexivity|].
  apply andb_prop in H. destruct H as [H K]. apply andb_prop in H. destruct H as [H H'].
  apply Nat.ltb_lt in H. apply Nat.ltb_lt in H'. rewrite (E a H), (E' c H'), (IH K). reflexivity.
Qed.

Definition dim l := (size_of (the_space M (space_of M l)) * degree M)%nat.
Definition is_local l :=
  forallb (bil_below (dim l) (dim l)) (P_rows M l)
  && forallb (lin_below (dim l)) (W_rows M l)
  && all (N M) (fun m => forallb (lin_below (dim m)) (A_rows M l m)
                         && forallb (lin_below (dim m)) (A_rows C l m)).

(** ** The checker *)

(** A product with a unit, as a matrix. *)
Definition with_left (P : ztable (nat * nat)) i : ztable nat :=
  (fst P, map (flat_map (fun '(a, c, q) => if Nat.eqb a i then [(c, q)] else [])) (snd P)).
Definition with_right (P : ztable (nat * nat)) j : ztable nat :=
  (fst P, map (flat_map (fun '(a, c, q) => if Nat.eqb c j then [(a, q)] else [])) (snd P)).

Lemma with_left_is P i y : zapp (with_left P i) y = zmul P (zunit i) y.
Proof.
  unfold zapp, zmul, with_left. cbn [fst snd]. rewrite map_map. f_equal; [|simpl; lia].
  apply map_ext. intros ts. induction ts as [|[[a c] q] ts IH]; [reflexivity|].
  cbn [flat_map zbil]. rewrite zunit_at. destruct (Nat.eqb a i); cbn [List.app zlin]; rewrite IH;
    ring.
Qed.
Lemma with_right_is P j x : zapp (with_right P j) x = zmul P x (zunit j).
Proof.
  unfold zapp, zmul, with_right. cbn [fst snd]. rewrite map_map. f_equal; [|simpl; lia].
  apply map_ext. intros ts. induction ts as [|[[a c] q] ts IH]; [reflexivity|].
  cbn [flat_map zbil]. rewrite zunit_at. destruct (Nat.eqb c j); cbn [List.app zlin]; rewrite IH;
    ring.
Qed.

Definition vanishes (u v w : zvec) : bool :=
  all (degree M) (fun e => Qeq_bool (val u e + val v e - val w e) 0).

(** The defect of a block at all units; F multiplies numbers. *)
Definition block_is_conjugate (T T' : ztables) (F : ztable (nat * nat)) l m : bool :=
  let xs := table (dim l) (fun i =>
    (with_left (Pz T l) i, zapp (Az T m l) (zunit i), zapp (Wz T l) (zunit i))) in
  let ys := table (dim m) (fun j =>
    (with_right (Pz T m) j, zapp (Az T' l m) (zunit j), zapp (Wz T m) (zunit j))) in
  forallb (fun '(Px, Ax, bx) => forallb (fun '(Py, Ay, by_) =>
    vanishes (zapp (Wz T l) (zapp Px Ay)) (zapp (Wz T m) (zapp Py Ax)) (zmul F bx by_)) ys) xs.

Definition conjugate_is_proved : bool :=
  let T := the_tables M in let T' := the_tables C in let F := zt (product_table M (Points 1)) in
  all (N M) is_local &&
  all (N M) (fun l => all (N M) (fun m =>
    eqb (is_seen C l m) (is_seen M m l) &&
    (negb (is_seen M m l) || block_is_conjugate T T' F l m))).

Hypothesis same_field : field C = field M.
Hypothesis same_spaces : spaces C = spaces M.
Hypothesis same_colours : colours C = colours M.
Hypothesis proved : conjugate_is_proved = true.

Lemma both_val l m e i j : (l < N M)%nat -> (m < N M)%nat -> (e < degree M)%nat ->
  both l m e (unit i) (unit j) == val (zmul (zt (product_table M (Points 1)))
    (zapp (Wz (the_tables M) l) (zunit i)) (zapp (Wz (the_tables M) m) (zunit j))) e.
Proof.
  intros Hl Hm He. rewrite (zmul_val _ _ _ e), product_table_is. unfold mul.
  rewrite field_product by exact He. unfold both.
  fold (sum (list_prod (seq 0 (degree M)) (seq 0 (degree M)))
    (fun p => in_field M e (fst p) (snd p) * (b M l (fst p) (unit i) * b M m (snd p) (unit j)))).
  rewrite sum_pairs. apply sum_ext. intros u Hu. apply sum_ext. intros v Hv. cbn [fst snd].
  apply in_seq in Hu. apply in_seq in Hv. unfold unit.
  rewrite !(b_val M _ eq_refl) by lia. ring.
Qed.

Lemma unit_defect_is_0 l m e i j : (l < N M)%nat -> (m < N M)%nat -> (e < degree M)%nat ->
  (i < dim l)%nat -> (j < dim m)%nat ->
  block_is_conjugate (the_tables M) (the_tables C) (zt (product_table M (Points 1))) l m = true ->
  defect l m e (unit i) (unit j) == 0.
Proof.
  intros Hl Hm He Hi Hj K. unfold block_is_conjugate in K. cbv zeta in K.
  rewrite forallb_forall in K. specialize (K _ (in_map _ _ i (proj2 (in_seq (dim l) 0 i)
    ltac:(lia)))).
  cbv beta iota in K. rewrite forallb_forall in K.
  specialize (K _ (in_map _ _ j (proj2 (in_seq (dim m) 0 j) ltac:(lia)))). cbv beta iota in K.
  pose proof (all_at _ _ K e He) as E. apply Qeq_bool_iff in E.
  rewrite with_left_is, with_right_is in E.
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

Lemma nth_forallb {X} (c : list X -> bool) rs i : c [] = true -> forallb c rs = true ->
  c (nth i rs []) = true.
Proof.
  intros Z H. rewrite forallb_forall in H.
  destruct (nth_in_or_default i rs []) as [K|K]; [apply H, K|rewrite K; exact Z].
Qed.

Theorem proved_conjugate : is_conjugate.
Proof.
  split; [exact same_field|]. split; [exact same_spaces|]. split; [exact same_colours|].
  pose proof proved as H. unfold conjugate_is_proved in H.
  cbv zeta in H. apply andb_prop in H. destruct H as [Lo D].
  intros l m Hl Hm. pose proof (all_at _ _ (all_at _ _ D l Hl) m Hm) as K. cbv beta in K.
  apply andb_prop in K. destruct K as [Se K]. apply eqb_prop in Se.
  split; [rewrite !seen_iff, Se; reflexivity|].
  intros Hs e x y He. rewrite seen_iff in Hs. rewrite Hs in K. cbn [negb orb] in K.
  pose proof (all_at _ _ Lo l Hl) as Ll. pose proof (all_at _ _ Lo m Hm) as Lm.
  unfold is_local, P_rows in Ll, Lm. rewrite product_table_is in Ll, Lm.
  apply andb_prop in Ll. destruct Ll as [Ll LA]. apply andb_prop in Ll. destruct Ll as [LP LW].
  apply andb_prop in Lm. destruct Lm as [Lm MA]. apply andb_prop in Lm. destruct Lm as [MP MW].
  pose proof (all_at _ _ LA m Hm) as LAm. apply andb_prop in LAm. destruct LAm as [_ LC].
  rewrite A_rows_are in LC.
  pose proof (all_at _ _ MA l Hl) as MAl. apply andb_prop in MAl. destruct MAl as [ML _].
  rewrite A_rows_are in ML.
  assert (Bl : forall u z w, (u < degree M)%nat -> (forall k, (k < dim l)%nat -> z k == w k) ->
    b M l u z == b M l u w) by (intros u z w Hu; apply lin_local; rewrite <- W_at by exact Hu;
    apply nth_forallb; [reflexivity|exact LW]).
  assert (Bm : forall u z w, (u < degree M)%nat -> (forall k, (k < dim m)%nat -> z k == w k) ->
    b M m u z == b M m u w) by (intros u z w Hu; apply lin_local; rewrite <- W_at by exact Hu;
    apply nth_forallb; [reflexivity|exact MW]).
  assert (U : forall u v, In (u, v) (list_prod (seq 0 (degree M)) (seq 0 (degree M))) ->
      (u < degree M)%nat /\ (v < degree M)%nat).
  { intros u v I. apply in_prod_iff in I. rewrite !in_seq in I. lia. }
  apply (zero_on_units (dim l) (fun x => defect l m e x y)).
  - apply defect_left.
  - intros z w E. unfold defect. apply Qplus_comp; [apply Qplus_comp|apply Qopp_comp].
    + apply (l_ext _ (b_linear l e)). intros k.
      apply (bil_local (dim l) (dim l)); [apply nth_forallb; [reflexivity|exact LP]|exact
        E|reflexivity].
    + apply (l_ext _ (b_linear m e)). intros k. apply (l_ext _ (bil_left (Pof M m k) y)). intros n.
      apply (lin_local (dim l)); [|exact E]. apply (nth_forallb (lin_below (dim l)));
        [reflexivity|exact ML].
    + unfold both. induction (list_prod _ _) as [|[u v] r IH]; simpl; [reflexivity|].
      destruct (U u v (or_introl eq_refl)) as [Hu Hv].
      rewrite IH by (intros; apply U; right; assumption). rewrite (Bl u z w Hu E). reflexivity.
  - intros i Hi. apply (zero_on_units (dim m) (defect l m e (unit i))).
    + apply defect_right.
    + intros z w E. unfold defect. apply Qplus_comp; [apply Qplus_comp|apply Qopp_comp].
      * apply (l_ext _ (b_linear l e)). intros k.
      apply (l_ext _ (bil_right (Pof M l k) (unit i))). intros n.
        apply (lin_local (dim m)); [|exact E]. apply (nth_forallb (lin_below (dim m)));
          [reflexivity|exact LC].
      * apply (l_ext _ (b_linear m e)). intros k.
        apply (bil_local (dim m) (dim m)); [apply nth_forallb; [reflexivity|exact
          MP]|reflexivity|exact E].
      * unfold both. induction (list_prod _ _) as [|[u v] r IH]; simpl; [reflexivity|].
        destruct (U u v (or_introl eq_refl)) as [Hu Hv].
        rewrite IH by (intros; apply U; right; assumption). rewrite (Bm v z w Hv E). reflexivity.
    + intros j Hj. apply unit_defect_is_0; assumption.
Qed.
End Conjugate.
