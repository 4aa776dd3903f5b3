(** * The symplectic conjugate and the symplectic pair

    The conjugate is recognised without division: Â^{l,m} is the block for which
    b_l(x ⊙ Â^{l,m} y) + b_m(A^{m,l} x ⊙ y) = b_l(x) b_m(y) for all stage values x and y; at points
    this is b_i b_j = b_i â_ij + b_j a_ji. *)

From Coq Require Import QArith ZArith List Arith Lia Bool.
From Gark Require Import Stages Trees Methods Check.
Import ListNotations.
Open Scope Q_scope.

Section Conjugate.
Variable M C : method.

(** The coefficient of θ^e in b_l(x) b_m(y). *)
Definition both l m e (x y : V) : Q :=
  fold_right Qplus 0 (map (fun p => in_field M e (fst p) (snd p) * (b M l (fst p) x * b M m (snd p) y))
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

Lemma unit_at i j : unit i j == if Nat.eqb j i then 1 else 0.
Proof.
  unfold unit, val, zunit; simpl. destruct (Nat.eqb_spec j i) as [->|H].
  - rewrite app_nth2, repeat_length, Nat.sub_diag by (rewrite repeat_length; lia). reflexivity.
  - destruct (lt_dec j i) as [L|L].
    + rewrite app_nth1 by (rewrite repeat_length; lia). rewrite nth_repeat. reflexivity.
    + rewrite nth_overflow; [reflexivity|]. rewrite app_length, repeat_length. simpl. lia.
Qed.

Fixpoint cut n (x : V) : V :=
  match n with O => fun _ => 0 | S n => add (cut n x) (scale (x n) (unit n)) end.

Lemma cut_at n x j : cut n x j == if Nat.ltb j n then x j else 0.
Proof.
  induction n; [reflexivity|]. cbn [cut]. unfold add, scale. rewrite IHn, unit_at.
  destruct (Nat.eqb_spec j n) as [->|H].
  - rewrite Nat.ltb_irrefl. replace (Nat.ltb n (S n)) with true by (symmetry; apply Nat.ltb_lt; lia). ring.
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
  apply (linear_sum _ (fun p x => in_field M e (fst p) (snd p) * (b M l (fst p) x * b M m (snd p) y))).
  intros p. apply linear_times.
  apply linear_ext with (f := fun x => b M m (snd p) y * b M l (fst p) x); [intros; ring|].
  apply linear_times, b_linear.
Qed.
Lemma both_right l m e x : linear (both l m e x).
Proof.
  apply (linear_sum _ (fun p y => in_field M e (fst p) (snd p) * (b M l (fst p) x * b M m (snd p) y))).
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
  && all (degree M) (fun e => lin_below (dim l) (weights M l e))
  && all (N M) (fun m => forallb (lin_below (dim m)) (A_rows M l m)
                         && forallb (lin_below (dim m)) (A_rows C l m)).

(** ** The checker *)

Definition zb l e (x : zvec) : Q :=
  let y := zapp (zt [weights M l e]) x in nth 0 (fst y) 0%Z # snd y.

(** The defect at two units; the tables are made once for all of them. *)
Definition unit_defect_by Pl Pm Alm Aml l m e (i j : nat) : Q :=
  zb l e (zmul Pl (zunit i) (zapp Alm (zunit j)))
  + zb m e (zmul Pm (zapp Aml (zunit i)) (zunit j))
  - fold_right Qplus 0 (map (fun p =>
        in_field M e (fst p) (snd p) * (zb l (fst p) (zunit i) * zb m (snd p) (zunit j)))
      (list_prod (seq 0 (degree M)) (seq 0 (degree M)))).
Definition unit_defect l m := unit_defect_by (zt (P_rows M l)) (zt (P_rows M m))
  (zt (A_rows C l m)) (zt (A_rows M m l)) l m.

Definition conjugate_is_proved : bool :=
  tables_are_whole M && tables_are_whole C && all (N M) is_local &&
  all (N M) (fun l => all (N M) (fun m =>
    eqb (is_seen C l m) (is_seen M m l) &&
    (negb (is_seen M m l) ||
      let Pl := zt (P_rows M l) in let Pm := zt (P_rows M m) in
      let Alm := zt (A_rows C l m) in let Aml := zt (A_rows M m l) in
      all (degree M) (fun e => all (dim l) (fun i => all (dim m) (fun j =>
        Qeq_bool (unit_defect_by Pl Pm Alm Aml l m e i j) 0)))))).

Hypothesis same_field : field C = field M.
Hypothesis same_spaces : spaces C = spaces M.
Hypothesis same_colours : colours C = colours M.
Hypothesis proved : conjugate_is_proved = true.

Lemma zb_val l e v : tables_are_whole M = true -> (l < N M)%nat -> (e < degree M)%nat ->
  b M l e (val v) == zb l e v.
Proof. intros T Hl He. rewrite (b_val M T l e v Hl He). reflexivity. Qed.

Lemma unit_defect_val l m e i j : tables_are_whole M = true -> tables_are_whole C = true ->
  (l < N M)%nat -> (m < N M)%nat -> (e < degree M)%nat ->
  defect l m e (unit i) (unit j) == unit_defect l m e i j.
Proof.
  intros T T' Hl Hm He. unfold defect, unit_defect, unit_defect_by.
  destruct (tables_of M T l Hl) as [_ [Pl _]].
  destruct (tables_of M T m Hm) as [_ [Pm [Am _]]].
  assert (Hl' : (l < N C)%nat) by (unfold N; rewrite same_colours; exact Hl).
  assert (Hm' : (m < N C)%nat) by (unfold N; rewrite same_colours; exact Hm).
  destruct (tables_of C T' l Hl') as [_ [_ [Al _]]].
  rewrite <- !(zb_val) by assumption.
  apply Qplus_comp; [apply Qplus_comp|apply Qopp_comp].
  - apply (l_ext _ (b_linear l e)). intros k. symmetry. revert k.
    eapply veq_trans; [apply zmul_val, Pl|]. apply mul_ext; [apply veq_refl|].
    apply (zapp_val _ _ (Al m Hm')).
  - apply (l_ext _ (b_linear m e)). intros k. symmetry. revert k.
    eapply veq_trans; [apply zmul_val, Pm|]. apply mul_ext; [|apply veq_refl].
    apply (zapp_val _ _ (Am l Hl)).
  - unfold both. assert (U : forall u v, In (u, v) (list_prod (seq 0 (degree M)) (seq 0 (degree M))) ->
      (u < degree M)%nat /\ (v < degree M)%nat).
    { intros u v K. apply in_prod_iff in K. rewrite !in_seq in K. lia. }
    induction (list_prod _ _) as [|[u v] r IH]; simpl; [reflexivity|].
    destruct (U u v (or_introl eq_refl)) as [Hu Hv].
    rewrite IH by (intros; apply U; right; assumption).
    rewrite <- !zb_val by assumption. reflexivity.
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
  apply andb_prop in H. destruct H as [H D]. apply andb_prop in H. destruct H as [H Lo].
  apply andb_prop in H. destruct H as [T T'].
  intros l m Hl Hm. pose proof (all_at _ _ (all_at _ _ D l Hl) m Hm) as K. cbv beta in K.
  apply andb_prop in K. destruct K as [Se K]. apply eqb_prop in Se.
  split; [rewrite !seen_iff, Se; reflexivity|].
  intros Hs e x y He. rewrite seen_iff in Hs. rewrite Hs in K. cbn [negb orb] in K. cbv zeta in K.
  pose proof (all_at _ _ Lo l Hl) as Ll. pose proof (all_at _ _ Lo m Hm) as Lm.
  unfold is_local in Ll, Lm.
  apply andb_prop in Ll. destruct Ll as [Ll LA]. apply andb_prop in Ll. destruct Ll as [LP LW].
  apply andb_prop in Lm. destruct Lm as [Lm MA]. apply andb_prop in Lm. destruct Lm as [MP MW].
  pose proof (all_at _ _ LA m Hm) as LAm. apply andb_prop in LAm. destruct LAm as [_ LC].
  pose proof (all_at _ _ MA l Hl) as MAl. apply andb_prop in MAl. destruct MAl as [ML _].
  assert (Bl : forall u z w, (u < degree M)%nat -> (forall k, (k < dim l)%nat -> z k == w k) ->
    b M l u z == b M l u w) by (intros u z w Hu; apply lin_local, (all_at _ _ LW u Hu)).
  assert (Bm : forall u z w, (u < degree M)%nat -> (forall k, (k < dim m)%nat -> z k == w k) ->
    b M m u z == b M m u w) by (intros u z w Hu; apply lin_local, (all_at _ _ MW u Hu)).
  assert (U : forall u v, In (u, v) (list_prod (seq 0 (degree M)) (seq 0 (degree M))) ->
      (u < degree M)%nat /\ (v < degree M)%nat).
  { intros u v I. apply in_prod_iff in I. rewrite !in_seq in I. lia. }
  apply (zero_on_units (dim l) (fun x => defect l m e x y)).
  - apply defect_left.
  - intros z w E. unfold defect. apply Qplus_comp; [apply Qplus_comp|apply Qopp_comp].
    + apply (l_ext _ (b_linear l e)). intros k.
      apply (bil_local (dim l) (dim l)); [apply nth_forallb; [reflexivity|exact LP]|exact E|reflexivity].
    + apply (l_ext _ (b_linear m e)). intros k. apply (l_ext _ (bil_left (Pof M m k) y)). intros n.
      apply (lin_local (dim l)); [|exact E]. apply (nth_forallb (lin_below (dim l))); [reflexivity|exact ML].
    + unfold both. induction (list_prod _ _) as [|[u v] r IH]; simpl; [reflexivity|].
      destruct (U u v (or_introl eq_refl)) as [Hu Hv].
      rewrite IH by (intros; apply U; right; assumption). rewrite (Bl u z w Hu E). reflexivity.
  - intros i Hi. apply (zero_on_units (dim m) (defect l m e (unit i))).
    + apply defect_right.
    + intros z w E. unfold defect. apply Qplus_comp; [apply Qplus_comp|apply Qopp_comp].
      * apply (l_ext _ (b_linear l e)). intros k. apply (l_ext _ (bil_right (Pof M l k) (unit i))). intros n.
        apply (lin_local (dim m)); [|exact E]. apply (nth_forallb (lin_below (dim m))); [reflexivity|exact LC].
      * apply (l_ext _ (b_linear m e)). intros k.
        apply (bil_local (dim m) (dim m)); [apply nth_forallb; [reflexivity|exact MP]|reflexivity|exact E].
      * unfold both. induction (list_prod _ _) as [|[u v] r IH]; simpl; [reflexivity|].
        destruct (U u v (or_introl eq_refl)) as [Hu Hv].
        rewrite IH by (intros; apply U; right; assumption). rewrite (Bm v z w Hv E). reflexivity.
    + intros j Hj. rewrite (unit_defect_val l m e i j T T' Hl Hm He). apply Qeq_bool_iff.
      apply (all_at _ _ (all_at _ _ (all_at _ _ K e He) i Hi) j Hj).
Qed.
End Conjugate.
